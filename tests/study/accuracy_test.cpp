#include "study/accuracy.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "study/accuracy_report.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape {
namespace {

using test::SceneFolder;

/// A small soft cloth that has begun to swing.
const std::string small_scene = R"([cloth]
mesh = { grid = [5, 5] }
mass = 1
stiffness = 20
pins = ["corner:x-y-", "corner:x+y-"]
[time]
step = 0.02
duration = 4
[integrator]
method = "liu13"
tolerance = 1e-3
[effects.gravity]
)";

TEST(Distance, IsTheLargestAndTheRootOfTheMeanSquare) {
  Vertices a = Vertices::Zero(4, 3), b = a;
  b.row(2) << 3, 0, 4;
  EXPECT_DOUBLE_EQ(distance(a, b).max, 5);
  EXPECT_DOUBLE_EQ(distance(a, b).rms, 2.5);
}

TEST(ReferenceMotion, IsTheSameByNewtonAndQuasiNewton) {
  const SceneFolder folder;
  const Scene scene = folder.load(small_scene);
  Progress progress;
  const auto reference = run_reference(scene.simulation, 20, {0, 7, 20}, {}, progress);
  ASSERT_TRUE(reference);
  ASSERT_EQ(reference->states.size(), 3U);
  EXPECT_EQ(reference->states[1].step, 7);
  EXPECT_EQ(reference->apart.size(), 20U);
  EXPECT_LT(reference->apart_after(20), 1e-10);
  EXPECT_GT(reference->apart_after(20), 0);  // they are two
  EXPECT_FALSE(reference->first_beyond(1e-6));
  EXPECT_EQ(reference->first_beyond(-1), 1);
}

TEST(ReferenceMotion, StopsWhenItIsAskedTo) {
  const SceneFolder folder;
  std::stop_source stop;
  stop.request_stop();
  Progress progress;
  EXPECT_FALSE(run_reference(folder.load(small_scene).simulation, 20, {0}, stop.get_token(), progress));
}

TEST(ExactSteps, TheErrorOfTheSolveFallsWithTheTolerance) {
  const SceneFolder folder;
  const Scene scene = folder.load(small_scene);
  Progress progress;
  const auto reference = run_reference(scene.simulation, 20, {5, 10, 20}, {}, progress);
  const ExactSteps exact(scene.simulation, reference->states, 1e-6);
  EXPECT_EQ(exact.count(), 3U);
  EXPECT_EQ(exact.left_out(), 0U);
  EXPECT_LT(exact.apart(), 1e-10);
  for (const Method method : {Method::implicit, Method::liu13, Method::quasi_newton}) {
    SCOPED_TRACE(method_name(method));
    SolveError before{1, 1, 1};
    for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-9}) {
      const SolveError error = exact.error({.method = method, .tolerance = tolerance, .max_iterations = 5000});
      EXPECT_LT(error.max, before.max);
      EXPECT_LT(error.rms, error.max);
      EXPECT_LT(error.gradient, before.gradient);
      before = error;
    }
    EXPECT_LT(before.max, 1e-7);
  }
}

TEST(ExactSteps, LeavesOutStatesWhoseMinimiserIsNotKnown) {
  const SceneFolder folder;
  const Scene scene = folder.load(small_scene);
  Progress progress;
  const auto reference = run_reference(scene.simulation, 4, {1, 4}, {}, progress);
  EXPECT_EQ(ExactSteps(scene.simulation, reference->states, -1).left_out(), 2U);
}

class StudyOfASmallCloth : public ::testing::Test {
 protected:
  static SceneAccuracy study(AccuracyOptions options) {
    const SceneFolder folder;
    const std::string file = folder.write("small.toml", small_scene).string();
    Progress progress;
    return *study_accuracy("small", file, options, {}, progress);
  }
};

// Implicit and symplectic Euler are both of first order (Hairer, Lubich and Wanner, "Geometric Numerical Integration",
// section I.1), velocity Verlet and SDIRK2 of second.
TEST_F(StudyOfASmallCloth, EveryMethodHasItsOrderInTheTimeStep) {
  AccuracyOptions options;
  options.tolerances = {1e-3};
  options.times = {0.2};
  options.steps = {0.005, 0.0025, 0.00125};
  options.runs = 1;
  const SceneAccuracy result = study(options);
  ASSERT_EQ(result.steps.size(), 24U);
  for (const StepPoint& point : result.steps) {
    if (point.step != 0.00125) continue;
    const bool second = point.method == Method::verlet || point.method.scheme == TimeScheme::sdirk2;
    EXPECT_NEAR(point.order, second ? 2 : 1, 0.08) << step_method_name(point.method);
  }
  EXPECT_LT(result.step_apart, 1e-9);
  EXPECT_TRUE(result.notes.empty());
}

TEST_F(StudyOfASmallCloth, TheErrorOfTheMotionFallsWithTheToleranceAndNothingIsChaotic) {
  AccuracyOptions options;
  options.methods = {Method::quasi_newton};
  options.tolerances = {1e-1, 1e-3, 1e-6};
  options.times = {0.1, 0.4};
  options.steps = {0.02};
  options.runs = 2;
  const SceneAccuracy result = study(options);
  ASSERT_EQ(result.points.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(result.points[i].motion.size(), 2U);
    EXPECT_EQ(result.points[i].measured.microseconds.size(), 2U);
    EXPECT_EQ(result.points[i].measured.setup.size(), 2U);
    if (i == 0) continue;
    EXPECT_LT(result.points[i].motion[1].max, result.points[i - 1].motion[1].max);
  }
  EXPECT_FALSE(result.chaotic_from);
  const StudyReport report = accuracy_report({result}, "drape study accuracy small.toml", {{}}, 1);
  EXPECT_NE(to_text(report).find("quasi-newton"), std::string::npos);
}

TEST(AccuracyOptions, MustFitTheMotion) {
  const SceneFolder folder;
  const Scene scene = folder.load(small_scene);
  const auto problem = [&](const AccuracyOptions& options) {
    return test::usage_error([&] { static_cast<void>(complete(options, scene)); });
  };
  AccuracyOptions late, uneven;
  late.times = {5};
  EXPECT_NE(problem(late).find("5 s is beyond the motion"), std::string::npos);
  uneven.times = {0.1};
  uneven.steps = {0.03};
  EXPECT_NE(problem(uneven).find("0.03 s does not divide 0.1 s"), std::string::npos);
  const AccuracyOptions whole = complete({}, scene);
  EXPECT_EQ(whole.methods.size(), step_methods.size());
  EXPECT_EQ(whole.times.size(), 3U);
  EXPECT_DOUBLE_EQ(whole.times.back(), 1);
  EXPECT_DOUBLE_EQ(whole.steps.front(), 0.02);
}

TEST(Cheapest, IsTheLeastCostlyBelowTheLimitAndTheNextIsOfAnotherMethod) {
  const std::vector<Offer> offers{{"a", "1", 1e-2, {1, 1, 1}},
                                  {"a", "2", 1e-4, {5, 5, 5}},
                                  {"a", "3", 1e-5, {6, 6, 6}},
                                  {"b", "1", 1e-4, {7, 7, 7}},
                                  {"b", "2", 1e-7, {9, 9, 9}}};
  EXPECT_EQ(find_cheapest(offers, 1e-3).first, &offers[1]);
  EXPECT_EQ(find_cheapest(offers, 1e-3).next, &offers[3]);
  EXPECT_EQ(find_cheapest(offers, 1e-6).first, &offers[4]);
  EXPECT_EQ(find_cheapest(offers, 1e-6).next, nullptr);
  EXPECT_EQ(find_cheapest(offers, 1e-9).first, nullptr);
  // A tighter tolerance that gives the same iterations is not cheaper, whatever the clock says.
  const std::vector<Offer> same{{"a", "1", 1e-4, {5, 5, 5}}, {"a", "2", 1e-4, {4, 4, 4}}};
  EXPECT_EQ(find_cheapest(same, 1e-3).first, &same[0]);
}

}  // namespace
}  // namespace drape
