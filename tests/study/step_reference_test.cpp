#include "study/reference.hpp"

#include <gtest/gtest.h>

#include "study/accuracy.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape {
namespace {

const std::string soft_scene = R"([cloth]
mesh = { grid = [5, 5] }
stiffness = 20
pins = ["corner:x-y-", "corner:x+y-"]
[time]
step = 0.02
duration = 1
[effects.gravity]
)";

// Verlet's small steps, and those of SDIRK2 if a field is too steep for Verlet.
TEST(StepReference, IsNearerToTheMotionTheSmallerItsStepsAre) {
  const test::SceneFolder folder;
  const std::string solved = "[effects.field]\nacceleration = [\"-1e-9*vx\", \"0\", \"0\"]\nstiffness_bound = 1e9\n";
  const auto reference = [&folder](const std::string& text, std::int64_t parts, double wanted) {
    Progress progress;
    return *extrapolate_steps(folder.load(text).simulation, {5, 10}, parts, wanted, {}, progress);
  };
  const StepReference finest = reference(soft_scene, 256, 1);
  for (const std::string& text : {soft_scene, soft_scene + solved}) {
    const StepReference coarse = reference(text, 8, 1), fine = reference(text, 16, 1);
    EXPECT_LE(coarse.step, 0.02 / 8);
    EXPECT_LT(fine.gained(1), coarse.gained(1) / 2);
    for (const StepReference* one : {&coarse, &fine}) {
      EXPECT_LT(distance(one->x[0], finest.x[0]).max, one->apart);
      EXPECT_LT(distance(one->x[1], finest.x[1]).max, 0.5 * one->gained(1));
    }
  }
  const StepReference plain = reference(soft_scene, 8, 1);
  const double wanted = plain.gained(0) / 10;
  const StepReference refined = reference(soft_scene, 8, wanted);
  EXPECT_EQ(refined.step, plain.step / 4);  // of second order: each halving reduces the error fourfold
  EXPECT_LE(refined.gained(0), wanted);
}

TEST(CaseRuns, TheCostOfAMotionHasItsShareOfTheSetUp) {
  CaseRuns runs;
  runs.study_case.steps = 10;
  runs.step = 0.02;
  runs.microseconds = {5, 7, 6};
  runs.setup = {10, 20, 40};
  EXPECT_DOUBLE_EQ(runs.cost().median, 1e-3 * 9 / 0.02);
  EXPECT_DOUBLE_EQ(runs.time().median, 6);
}

}  // namespace
}  // namespace drape
