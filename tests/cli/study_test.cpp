#include <gtest/gtest.h>

#include "tests/cli/run_drape.hpp"

namespace drape {
namespace {

using test::drape;
using test::Finished;
using test::SceneFolder;

/// The results have a page, its Markdown, and these files.
void expect_results(const SceneFolder& folder, std::vector<std::string> names) {
  names.insert(names.end(), {"report.html", "report.md"});
  for (const std::string& name : names) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "results" / name)) << name;
  }
}

TEST(Study, OfTheHomeworkWritesEverything) {
  const SceneFolder folder;
  const Finished finished = drape(folder, "study homework -o results --runs 1");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_NE(finished.text.find("Table 3"), std::string::npos) << finished.text;
  expect_results(folder, {"table1.csv", "table2.csv", "table3.csv", "energies.csv", "energy-log.csv",
                          "iterations-k18.csv", "iterations-k18.gp", "time-by-tolerance.gp"});
}

TEST(Study, NeedsAKindThatThereIs) {
  const SceneFolder folder;
  EXPECT_EQ(drape(folder, "study").code, 2);
  EXPECT_EQ(drape(folder, "study homwork").code, 2);
  EXPECT_EQ(drape(folder, "study homework --runs 0").code, 2);
}

const std::string swing = R"([cloth]
mesh = { grid = [4, 4] }
stiffness = 20
pins = ["corner:x-y-"]
[time]
step = 0.02
duration = 1
[integrator]
method = "liu13"
[effects.gravity]
)";

TEST(Study, OfAccuracyWritesEverythingForEveryScene) {
  const SceneFolder folder;
  folder.write("a.toml", swing);
  folder.write("b/a.toml", swing);
  const Finished finished =
      drape(folder,
            "study accuracy a.toml b/a.toml -o results --runs 1 --animate methods --methods liu13,implicit "
            "--tolerances 1e-2,1e-4 --times 0.1,0.2 --steps 0.02,0.01");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_NE(finished.text.find("for an error"), std::string::npos) << finished.text;
  expect_results(folder, {"b-a-solve.csv", "b-a-solve.gp", "b-a-motion-1.gp", "b-a-motion-2.gp", "b-a-step.gp",
                          "b-a-by-methods.gif", "b-a-step-cost.gp", "b-a-apart.gp", "b-a-tolerances.csv",
                          "b-a-steps.csv", "b-a-cheapest.csv"});
}

TEST(Study, OfAccuracySaysWhatItCannotMeasure) {
  const SceneFolder folder;
  folder.write("a.toml", swing);
  const auto expect_error = [&](const std::string& arguments, const std::string& message) {
    const Finished finished = drape(folder, "study accuracy " + arguments);
    EXPECT_EQ(finished.code, 2) << finished.text;
    EXPECT_NE(finished.text.find(message), std::string::npos) << finished.text;
  };
  expect_error("a.toml --methods lui13", "did you mean 'liu13'");
  expect_error("a.toml --times 2", "2 s is outside of the motion");
  expect_error("a.toml --times 0.1 --steps 0.03", "does not divide");
  expect_error("b.toml", "b.toml");
  expect_error("a.toml --tolerances -1", "--tolerances");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(Study, OfScalingWritesEverything) {
  const SceneFolder folder;
  const Finished finished = drape(folder, "study scaling --largest 10 --runs 1 -o results");
  EXPECT_EQ(finished.code, 0) << finished.text;
  expect_results(folder, {"scaling-times.csv", "scaling-growth.csv", "scaling-shares.csv", "scaling-step.gp",
                          "scaling-iteration.gp", "scaling-memory.gp"});
}

TEST(Study, OfStabilityWritesEverything) {
  const SceneFolder folder;
  const Finished finished = drape(folder, "study stability --per-decade 1 --steps 5 -o results");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_NE(finished.text.find("Where a method becomes unstable"), std::string::npos) << finished.text;
  expect_results(folder, {"border.csv", "semi-implicit-springs.csv", "semi-implicit-springs.gp", "liu13-springs.gp",
                          "implicit-explicit-push.gp", "quasi-newton-implicit-push.gp"});
}

TEST(Study, ThatIsInterruptedWritesNothing) {
  const SceneFolder folder;
  // In the foreground timeout sends one signal; else two, and the second ends drape at once.
  const Finished finished = drape(folder, "study stability --per-decade 20 -o results",
                                  "timeout --foreground --preserve-status --signal=INT 3");
  EXPECT_EQ(finished.code, 130) << finished.text;
  EXPECT_NE(finished.text.find("interrupted; there is no report"), std::string::npos) << finished.text;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "results"));
}

}  // namespace
}  // namespace drape
