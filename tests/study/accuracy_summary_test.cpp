#include "study/accuracy_report.hpp"

#include <gtest/gtest.h>

#include "tests/study/invented_study.hpp"

namespace drape {
namespace {

/// Makes steps of a first-order method whose cost is proportional to their number.
SceneAccuracy proportional_steps() {
  SceneAccuracy scene = test::invented_scene("a");
  scene.fixed.clear();
  for (const double h : {0.02, 0.01, 0.005}) {
    scene.fixed.push_back(test::invented_motion(scene.scene, Method::implicit, h, h, {1 / h}));
  }
  return scene;
}

TEST(BestFixedStep, LiesBetweenTheStepsThatWereRun) {
  const SceneAccuracy scene = proportional_steps();
  for (const double error : {0.02, 0.013, 0.01, 0.007, 0.005}) {
    EXPECT_NEAR(fixed_step_cost(scene, Method::implicit, error).value(), 1 / error, 1e-9 / error);
  }
  EXPECT_NEAR(fixed_step_cost(scene, Method::implicit, 1).value(), 50, 1e-9) << "the longest is enough";
  EXPECT_FALSE(fixed_step_cost(scene, Method::implicit, 0.004)) << "none is short enough";
  EXPECT_FALSE(fixed_step_cost(scene, Method::verlet, 1)) << "none was run";
}

TEST(BestFixedStep, IsTheCheapestWhereShorterOnesCostLess) {
  SceneAccuracy scene = proportional_steps();
  scene.fixed.back().measured = test::invented_runs(scene.scene, 0.02, {10});
  EXPECT_NEAR(fixed_step_cost(scene, Method::implicit, 0.02).value(), 10, 1e-9);
  scene.fixed.back().measured.failure = "it diverged";
  EXPECT_NEAR(fixed_step_cost(scene, Method::implicit, 0.02).value(), 50, 1e-9);
}

// For the invented runs: Newton's method reaches 50 µm in 90 ms and 0.5 mm in 40 ms, for which a fixed step of 0.01 s
// takes 20 ms.
TEST(AskedSummary, SaysWhatToTakeAndWhatItCostsBesideFixedSteps) {
  const auto summary = asked_summary({test::invented_scene("a")});
  ASSERT_TRUE(summary);
  ASSERT_EQ(summary->tables.size(), 3U);
  const std::vector<std::string> implicit{"a", "implicit", "implicit, accuracy = 0.001: 40.0",
                                          "implicit, accuracy = 0.001: 40.0", "implicit, accuracy = 0.0001: 90.0"};
  EXPECT_EQ(summary->tables[0].rows.at(1), implicit);
  const std::vector<std::string> costs{"a", "implicit", "0.5 mm, 40.0 ms, 2.00", "0.05 mm, 90.0 ms, –"};
  EXPECT_EQ(summary->tables[1].rows, (std::vector<std::vector<std::string>>{costs}));
  SceneAccuracy none = test::invented_scene("a");
  none.asked.clear();
  EXPECT_FALSE(asked_summary({none}));
}

// Its only tolerance has an error of 0.1 mm, in 2 ms per second with steps of 0.02 s.
TEST(SolveSummary, SaysWhatAStepCostsByItsError) {
  const auto summary = solve_summary({test::invented_scene("a")});
  ASSERT_TRUE(summary);
  const std::vector<std::string> row{"a", "implicit", "40.0", "–", "–", "–"};
  EXPECT_EQ(summary->tables.front().rows, (std::vector<std::vector<std::string>>{row}));
}

}  // namespace
}  // namespace drape
