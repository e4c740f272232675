// Motions that other simulators have made.

#include <gtest/gtest.h>

#include <cstdlib>

#include "audit/report/audit_motion.hpp"
#include "import/import_motion.hpp"
#include "motion/scene_folder.hpp"
#include "tests/support/scratch_folder.hpp"

namespace drape::interop {
namespace {

class Imported : public test::InScratchFolder {};

TEST_F(Imported, MujocosClothFallsFreelyAndIsAudited) {
  const char* const programs = std::getenv("DRAPE_INTEROP");
  if (programs == nullptr) GTEST_SKIP() << "script/interop installs MuJoCo and runs this";
  const std::string command = std::string("node '" DRAPE_SOURCE_DIR "/tests/interop/mujoco_cloth.mjs' '") + programs +
                              "/node_modules' '" + path("m") + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  Progress progress;
  const ImportedMotion found =
      import_motion({.cloths = {path("m/{frame:04}.obj")}, .fps = 50}, path("m.drape"), {}, progress);
  EXPECT_EQ(found.frames, 60);
  EXPECT_EQ(found.vertices, 441);
  EXPECT_EQ(found.triangles, 800);
  const auto reader = std::make_shared<MotionReader>(path("m.drape"));
  EXPECT_NEAR(reader->state(5).x.col(2).mean(), 1.2 - 0.5 * 9.81 * 0.1 * 0.1, 2e-3);  // symplectic Euler, h = 2 ms
  EXPECT_NEAR(reader->state(5).v.col(2).mean(), -9.81 * 0.1, 0.02);
  const MotionScene folder(*reader);
  const AuditReport report = audit_motion(folder.scene(), reader, {}, {}, progress);
  EXPECT_EQ(report.findings.states(), 60);
  // Its layers may go through each other, as it says itself: selfcollide="none".
  EXPECT_GT(report.findings.findings(audit::Check::crossings).states, 10);
  EXPECT_EQ(report.findings.findings(audit::Check::stuck).states, 0);
}

}  // namespace
}  // namespace drape::interop
