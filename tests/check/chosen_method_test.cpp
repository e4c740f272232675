// Goldens of scenes that name no method.

#include <gtest/gtest.h>

#include <regex>

#include "check/manifest.hpp"
#include "tests/check/checked_scene.hpp"

namespace drape::test {
namespace {

class ChosenMethod : public CheckedScene {
 protected:
  /// Writes the scene of CheckedScene with this [integrator] table.
  void write_scene(const std::string& integrator) {
    const std::regex table("\\[integrator\\][^\\[]*");
    put(folder_ / "swing.toml", std::regex_replace(std::string(small_swing), table, integrator));
  }
};

TEST_F(ChosenMethod, IsKeptInTheGoldenAndTaken) {
  write_scene("");
  ASSERT_TRUE(scene().choice.has_value());
  ASSERT_EQ(scene().simulation.integrator.method, Method::verlet);
  bless();
  const Manifest manifest = read_manifest(content(golden() / "manifest.json"));
  ASSERT_TRUE(manifest.golden.method.has_value());
  EXPECT_EQ(manifest.golden.method->method, Method::verlet);
  EXPECT_EQ(manifest.golden.method->substeps, scene().choice->substeps);
  const SceneResult result = check();
  EXPECT_EQ(result.verdict, SceneVerdict::passed);
  EXPECT_TRUE(result.findings.empty());
}

TEST_F(ChosenMethod, IsSaidToDifferFromThatOfTheGoldenWhichIsTaken) {
  // A golden of a drape that chose another method.
  write_scene("[integrator]\nmethod = \"quasi-newton\"\n");
  bless();
  EXPECT_FALSE(read_manifest(content(golden() / "manifest.json")).golden.method.has_value());
  write_scene("");
  const SceneResult result = check();
  EXPECT_EQ(result.windows.motion, MotionVerdict::same_bits);
  EXPECT_EQ(result.verdict, SceneVerdict::passed);
  ASSERT_FALSE(result.findings.empty());
  EXPECT_EQ(sentences(result)[0].find("the golden was recorded with quasi-newton, and is compared with that; today the "
                                      "scene has verlet in "),
            0u)
      << sentences(result)[0];
}

}  // namespace
}  // namespace drape::test
