#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"

namespace drape::audit_cli {
namespace {

using test::drape;
using test::Finished;
using test::SceneFolder;

/// A sheet that stays at rest without forces; a test makes a second one whose two layers fall through each other.
const std::string still = test::least_scene + "duration = 0.1\n[video]\nsize = [64, 48]\n";

TEST(Audit, FindsNothingInASheetThatLiesStill) {
  const SceneFolder folder;
  folder.write("still.toml", still);
  const Finished finished = drape(folder, "audit still.toml -o still.html");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_NE(finished.text.find("still.toml: nothing found in "), std::string::npos) << finished.text;
  EXPECT_NE(test::content(folder.path("still.html")).find("Nothing was found"), std::string::npos);
}

TEST(Audit, FindsWhatIsStretchedInARecordedMotionAndInItsScene) {
  const SceneFolder folder;
  folder.write("swing.toml", test::swinging_scene);
  ASSERT_EQ(drape(folder, "simulate swing.toml -o swing.drape --quiet").code, 0);
  const Finished scene = drape(folder, "audit swing.toml --max-stretch 1.0001 --quiet");
  const Finished motion = drape(folder, "audit swing.drape --max-stretch 1.0001 --quiet -o swing.html");
  EXPECT_EQ(scene.code, 1) << scene.text;
  EXPECT_EQ(motion.code, 1) << motion.text;
  EXPECT_EQ(scene.text.substr(scene.text.find('\n')), motion.text.substr(motion.text.find('\n')));
  EXPECT_NE(motion.text.find("is stretched to 1."), std::string::npos) << motion.text;
  const std::string page = test::content(folder.path("swing.html"));
  EXPECT_NE(page.find("drape audit swing.drape --max-stretch 1.0001 --quiet -o swing.html"), std::string::npos);
  EXPECT_NE(page.find("data:image/png;base64"), std::string::npos);
}

TEST(Audit, TakesTheStrainLimitOfASceneForThatOfEdges) {
  const SceneFolder folder;
  folder.write("limited.toml", test::swinging_scene + "[effects.strain_limit]\nmax_stretch = 1.05\n");
  const Finished finished = drape(folder, "audit limited.toml");
  EXPECT_NE(finished.text.find("stretch of edges           1.051"), std::string::npos) << finished.text;
}

/// Returns the names of the showcase's scenes.
std::vector<std::string> showcase() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(DRAPE_SOURCE_DIR "/scenes/showcase")) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

void expect_clean(const std::string& name) {
  const SceneFolder folder;
  const Finished finished = drape(folder, "audit " DRAPE_SOURCE_DIR "/scenes/showcase/" + name + ".toml --quiet");
  EXPECT_EQ(finished.code, 0) << finished.text;
}

// All edges respect the limit, and the cloth never meets itself, although it has no self-collision.
TEST(Audit, FindsNothingInTheShowcaseOfTheStrainLimit) { expect_clean("strain_limit"); }

class AuditOfShowcase : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Nightly, AuditOfShowcase, testing::ValuesIn(showcase()),
                         [](const auto& tested) { return tested.param; });

TEST_P(AuditOfShowcase, FindsNothing) { expect_clean(GetParam()); }

TEST(Audit, JudgesTheEnergyOnlyWhereNothingGivesAny) {
  const SceneFolder folder;
  folder.write("swing.toml", test::swinging_scene);
  folder.write("wind.toml", test::swinging_scene + "[effects.wind]\nacceleration = [1, 0, 0]\n");
  EXPECT_EQ(drape(folder, "audit swing.toml").text.find("not judged"), std::string::npos);
  EXPECT_NE(drape(folder, "audit wind.toml").text.find("may do work on the cloth"), std::string::npos);
  EXPECT_NE(
      drape(folder, "audit swing.toml --set integrator.method=verlet --set time.step=0.01").text.find("oscillates"),
      std::string::npos);
}

TEST(Audit, PlacesABodyWhereItIsAfterAStepInSubsteps) {
  const SceneFolder folder;
  folder.write("lift.toml", test::least_scene + R"(duration = 0.3
[integrator]
method = "verlet"
substeps = 4
[effects.gravity]
[effects.body]
box = [4, 4, 0.1]
center = [0, 0, -0.07]
velocity = [0, 0, -0.5]
thickness = 0.02
)");
  ASSERT_EQ(drape(folder, "simulate lift.toml -o lift.drape --quiet").code, 0);
  const Finished finished = drape(folder, "audit lift.drape");
  EXPECT_EQ(finished.code, 0) << "the cloth goes down with the body, which was above it earlier\n" << finished.text;
}

TEST(Audit, RefusesInOneMessageWithExitCode2) {
  const SceneFolder folder;
  folder.write("still.toml", still);
  const auto expect_refused = [&](const std::string& arguments, const std::string& message) {
    const Finished finished = drape(folder, "audit " + arguments);
    EXPECT_EQ(finished.code, 2) << arguments;
    EXPECT_NE(finished.text.find(message), std::string::npos) << finished.text;
  };
  expect_refused("missing.toml", "missing.toml");
  expect_refused("still.toml -o still.png", "expected a page's name, such as audit.html");
  expect_refused("still.toml still.toml -o still.html", "several motions need a name with {scene}");
  expect_refused("still.toml --max-stretch 0.5", "--max-stretch");
  expect_refused("still.toml --held 0,x", "--held: expected vertices from 0 to");
}

}  // namespace
}  // namespace drape::audit_cli
