#include "study/accuracy.hpp"
#include "drape/scene/scene.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "drape/sim/effects/ground.hpp"
#include "study/accuracy_report.hpp"
#include "study/animation.hpp"
#include "study/reference.hpp"
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
  EXPECT_GT(reference->apart_after(20), 0);  // they are two different runs
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

// Implicit and symplectic Euler are of first order (Hairer, Lubich and Wanner, "Geometric Numerical Integration",
// section I.1), velocity Verlet and SDIRK2 of second.
TEST_F(StudyOfASmallCloth, EveryMethodHasItsOrderInTheTimeStep) {
  AccuracyOptions options;
  options.tolerances = {1e-3};
  options.times = {0.2};
  options.steps = {0.005, 0.0025, 0.00125};
  options.runs = 1;
  options.parts = {.solve = false, .asked = false};
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
  options.runs = 2;
  options.parts = {.order = false, .asked = false};
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
  const StudyReport report = accuracy_report(
      {.command = "drape study accuracy small.toml", .scenes = {result}, .pictures = {{}}, .seconds = 1});
  EXPECT_NE(to_text(report).find("quasi-newton"), std::string::npos);
}

// The motion's error differs from the requested error per step, but a tenth of the latter at least halves it where the
// fewest substeps do not suffice.
TEST_F(StudyOfASmallCloth, TheErrorOfTheMotionFallsWithTheAccuracyThatIsAskedFor) {
  AccuracyOptions options;
  options.methods = {Method::quasi_newton, {Method::quasi_newton, TimeScheme::sdirk2}};
  options.accuracies = {1e-5, 1e-6};
  options.times = {0.2, 0.4};
  options.steps = {0.02, 0.01};
  options.runs = 1;
  options.parts = {.solve = false, .order = false};
  const SceneAccuracy result = study(options);
  ASSERT_EQ(result.asked.size(), 4U);
  ASSERT_EQ(result.fixed.size(), 4U);
  EXPECT_TRUE(result.points.empty() && result.steps.empty());
  for (const std::size_t time : {0U, 1U}) {
    EXPECT_LT(result.asked[1].errors[time].max, 0.5 * result.asked[0].errors[time].max);
    EXPECT_NEAR(result.fixed[0].errors[time].max / result.fixed[1].errors[time].max, 2, 0.2);
    EXPECT_GT(result.fixed[2].errors[time].max, 3 * result.fixed[3].errors[time].max);
    EXPECT_LT(result.step_gained[time], 0.1 * result.fixed[3].errors[time].max);
  }
  for (const MotionPoint& p : result.asked) {
    EXPECT_EQ(p.substeps.size(), 10U);  // steps up to the first time
    EXPECT_EQ(p.local_errors.size(), 10U);
    EXPECT_FALSE(p.flip);
    for (std::size_t i = 0; i < p.local_errors.size(); ++i) {
      EXPECT_LE(p.estimates[i], p.setting);
      EXPECT_LE(p.local_errors[i], 3 * p.setting);
      EXPECT_LE(p.local_unknown[i], 0.01 * p.setting);
    }
  }
  EXPECT_FALSE(result.contact_from);
}

// From rest a backward Euler step falls g·h² instead of ½·g·h², which small second-order steps do exactly.
TEST(LocalErrors, OfABackwardEulerStepInFreeFallIsHalfOfGTimesHSquared) {
  const SceneFolder folder;
  Scene scene = folder.load(small_scene, {"cloth.pins=[]"});
  const double h = scene.simulation.step;
  for (const bool ground : {false, true}) {
    if (ground) scene.simulation.effects.add(Ground{.height = -10});
    LocalErrors exact(scene.simulation);
    Simulation simulation(scene.simulation);
    const State before = simulation.state();
    simulation.step();
    const auto found = exact.of_step(before, simulation.state().x);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->error, 0.5 * 9.8 * h * h, 1e-9);
    EXPECT_LT(found->unknown, 1e-9);
  }
}

// Backward Euler is at −g·h²·n(n+1)/2 after n steps from rest.
TEST(FirstContact, OfAFallingClothIsTheStepThatWouldEndBelowTheGround) {
  const SceneFolder folder;
  Scene scene = folder.load(small_scene, {"cloth.pins=[]"});
  EXPECT_FALSE(first_contact(scene.simulation, 20, 1e-8, {}));
  const double h = scene.simulation.step, depth = 0.1;
  Ground ground;
  ground.height = scene.simulation.cloth.positions(0, 2) - depth - ground.thickness;
  scene.simulation.effects.add(ground);
  const std::int64_t step = first_contact(scene.simulation, 20, 1e-8, {}).value();
  const auto fallen = [&](std::int64_t n) { return 9.8 * h * h * static_cast<double>(n * (n + 1)) / 2; };
  EXPECT_GT(fallen(step), depth);
  EXPECT_LE(fallen(step - 1), depth);
  EXPECT_FALSE(first_contact(scene.simulation, step - 1, 1e-8, {}));
}

class JudgedFilm : public ::testing::Test {
 protected:
  JudgedFilm() {
    Progress progress;
    reference_ = *extrapolate_steps(scene_.simulation, steps_, 4, 1, {}, progress);
  }

  SceneFolder folder_;
  Scene scene_ = folder_.load(small_scene);
  std::vector<std::int64_t> steps_ = film_steps(scene_, 20);
  StepReference reference_;
};

TEST_F(JudgedFilm, OfTheReferenceItselfIsNoDifferent) {
  FilmJudge films(scene_, steps_, reference_, GlBackend::automatic);
  EXPECT_EQ(steps_, (std::vector<std::int64_t>{5, 10, 15, 20}));
  EXPECT_EQ(films.count(), 4U);
  for (std::size_t i = 0; i < steps_.size(); ++i) EXPECT_EQ(films.error(steps_[i], reference_.x[i]), 0);
  EXPECT_FALSE(films.error(7, reference_.x[0]));
  EXPECT_LT(films.unknown(), 0.01);
}

TEST_F(JudgedFilm, LooksTheMoreDifferentTheFurtherTheClothIsAway) {
  FilmJudge films(scene_, steps_, reference_, GlBackend::automatic);
  double before = 0;
  for (const double away : {0.01, 0.1, 0.5}) {
    Vertices x = reference_.x[1];
    x.col(2).array() += away;
    const double error = films.error(steps_[1], x).value();
    EXPECT_GT(error, before);
    EXPECT_LE(error, 1);
    before = error;
  }
}

TEST(AccuracyOptions, MustFitTheMotion) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(small_scene);
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

}  // namespace
}  // namespace drape
