// Motions of other simulators: a cloth of 21×21 vertices, 1.6 m wide and 1.2 m high, falls over a ball.

#include <gtest/gtest.h>

#include <cstdlib>

#include "audit/report/audit_motion.hpp"
#include "motion/import/import_motion.hpp"
#include "motion/reader.hpp"
#include "tests/support/scratch_folder.hpp"

namespace drape::interop {
namespace {

using audit::Check;

const std::string scripts = DRAPE_SOURCE_DIR "/tests/interop/simulators/";

class Imported : public test::InScratchFolder {
 protected:
  void SetUp() override {
    const char* const programs = std::getenv("DRAPE_INTEROP");
    if (programs == nullptr) GTEST_SKIP() << "script/interop installs the other simulators and runs this";
    modules_ = std::string(programs) + "/node_modules";
  }

  static bool succeeds(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

  /// Runs a simulator, imports its 60 frames, and expects the same fall in the first tenth of a second, before any
  /// contact.
  /// @returns the findings of its audit
  AuditReport fall(const std::string& command) {
    EXPECT_TRUE(succeeds(command)) << command;
    Progress progress;
    const ImportedMotion found =
        import_motion({.cloths = {path("m/{frame:04}.obj")}, .fps = 50}, path("m.drape"), {}, progress);
    EXPECT_EQ(found.frames, 60);
    EXPECT_EQ(found.vertices, 441);
    EXPECT_EQ(found.triangles, 800);
    const auto reader = std::make_shared<MotionReader>(path("m.drape"));
    EXPECT_NEAR(reader->state(5).x.col(2).mean(), 1.2 - 0.5 * 9.81 * 0.1 * 0.1, 3e-3);
    EXPECT_NEAR(reader->state(5).v.col(2).mean(), -9.81 * 0.1, 0.03);
    const MotionScene folder(*reader);
    AuditReport report = audit_motion(folder.scene(), reader, {}, {}, progress);
    EXPECT_EQ(report.findings.states(), 60);
    EXPECT_EQ(report.findings.findings(Check::stuck).states, 0);
    return report;
  }
  [[nodiscard]] std::string by_node(const std::string& script) const {
    return "node '" + scripts + script + "' '" + modules_ + "' '" + path("m") + "'";
  }

  std::string modules_;
};

TEST_F(Imported, MujocosClothFallsFreelyAndIsAudited) {
  // Its layers may pass through each other, because of selfcollide="none".
  EXPECT_GT(fall(by_node("mujoco_cloth.mjs")).findings.findings(Check::crossings).states, 10);
}

TEST_F(Imported, JoltsClothFallsFreelyAndIsAudited) {
  EXPECT_EQ(fall(by_node("jolt_cloth.mjs")).findings.findings(Check::crossings).states, 0);
}

TEST_F(Imported, BulletsClothFallsFreelyAndIsAudited) {
  if (!succeeds("pkg-config --exists bullet")) GTEST_SKIP() << "no Bullet: apt-get install libbullet-dev";
  ASSERT_TRUE(succeeds("c++ -std=c++17 -O1 '" + scripts + "bullet_cloth.cpp' -o '" + path("bullet") +
                       "' $(pkg-config --cflags --libs bullet)"));
  EXPECT_LT(fall("'" + path("bullet") + "' '" + path("m") + "'").findings.findings(Check::stretch).largest, 1.2);
}

TEST_F(Imported, BlendersClothOfQuadsFallsFreelyAndIsAudited) {
  if (!succeeds("command -v blender")) GTEST_SKIP() << "no Blender: apt-get install blender";
  EXPECT_EQ(fall("blender --background --python '" + scripts + "blender_cloth.py' -- '" + path("m") + "'")
                .findings.findings(Check::crossings)
                .states,
            0);
}

}  // namespace
}  // namespace drape::interop
