// A scene requests an accuracy per step, and steps are divided until they reach it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "drape/sim/effects/moving_pins.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"
#include "tests/support/setups.hpp"

namespace drape::test::asked_accuracy {
namespace {

constexpr double h = 0.02;

/// Makes 10×10 cells that swing from two corners.
SimulationSettings swinging(Solver solver, double accuracy, double stiffness = 180) {
  SimulationSettings settings = setup(cloth_of(make_grid(10, 10), 1, stiffness, {0, 10}), solver, h);
  settings.effects = {Gravity{}};
  settings.integrator.stop.reset();
  settings.integrator.tolerance.reset();
  settings.accuracy = accuracy;
  return settings;
}

double largest(const Vertices& a, const Vertices& b) { return (a - b).rowwise().norm().maxCoeff(); }

/// Returns the state after a step without errors of time stepping and solve, except those of Verlet's steps of h/2^9.
Vertices exact_step(const SimulationSettings& settings, State from) {
  constexpr int halvings = 9;
  SimulationSettings small = settings;
  small.accuracy.reset();
  small.integrator.method = Method::verlet;
  small.step = std::ldexp(settings.step, -halvings);
  Simulation simulation(small);
  from.step <<= halvings;
  simulation.restore(from);
  for (int i = 0; i < 1 << halvings; ++i) simulation.step();
  return simulation.state().x;
}

class AskedAccuracy : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, AskedAccuracy, testing::ValuesIn(all_methods), method_name);

TEST_P(AskedAccuracy, TheErrorFallsWithIt) {
  constexpr int steps = 15;
  SimulationSettings exact = swinging(Method::verlet, 1);
  exact.accuracy.reset();
  exact.step = h / 512;
  Simulation reference(exact);
  for (int i = 0; i < 512 * steps; ++i) reference.step();
  std::vector<double> errors;
  for (const double accuracy : {1e-2, 1e-3, 1e-4}) {
    Simulation simulation(swinging(GetParam(), accuracy));
    for (int i = 0; i < steps; ++i) simulation.step();
    const double error = largest(simulation.state().x, reference.state().x);
    // An error of a velocity persists, so the bound is the accuracy times the steps before and after.
    EXPECT_LE(error, steps * steps * accuracy) << accuracy;
    errors.push_back(error);
  }
  // Steps that are safe, or cheapest, may be more accurate than requested.
  EXPECT_LE(errors[1], 1.1 * errors[0]);
  EXPECT_LE(errors[2], std::max(0.2 * errors[0], steps * 1e-4));
}

// The cloth neither buckles nor touches anything in these steps.
TEST_P(AskedAccuracy, TheEstimateIsWithinAFactorOfThreeOfTheError) {
  for (const double accuracy : {1e-3, 1e-4}) {
    const SimulationSettings settings = swinging(GetParam(), accuracy);
    Simulation simulation(settings);
    int judged = 0, close = 0;
    for (int i = 0; i < 15; ++i) {
      const State before = simulation.state();
      const StepReport report = simulation.step();
      const double error = largest(simulation.state().x, exact_step(settings, before));
      ASSERT_TRUE(report.converged);
      ASSERT_TRUE(report.estimate);
      EXPECT_LE(*report.estimate, accuracy);
      EXPECT_LE(error, 10 * std::max(*report.estimate, accuracy / 10)) << "in step " << i;
      // The ratio is not judged where the error is far below the requested accuracy.
      if (std::max(error, *report.estimate) < 0.1 * accuracy) continue;
      ++judged;
      if (error <= 3 * *report.estimate && *report.estimate <= 3 * error) ++close;
    }
    EXPECT_GE(close, std::floor(0.95 * judged)) << judged << " steps, accuracy " << accuracy;
  }
}

TEST_P(AskedAccuracy, ARestoredStepHasTheSameBits) {
  const SimulationSettings settings = swinging(GetParam(), 1e-4);
  Simulation simulation(settings);
  std::vector<State> states;
  for (int i = 0; i < 8; ++i) {
    states.push_back(simulation.state());
    simulation.step();
  }
  Simulation other(settings);
  for (const int from : {6, 2, 7, 0}) {
    other.restore(states[static_cast<std::size_t>(from)]);
    while (other.state().step < 8) other.step();
    EXPECT_TRUE(same_bits(other.state().x, simulation.state().x)) << "from step " << from;
    EXPECT_TRUE(same_bits(other.state().v, simulation.state().v)) << "from step " << from;
  }
}

TEST_P(AskedAccuracy, PinsMoveThroughTheSubstepsAndAreReleasedInTheirStep) {
  SimulationSettings settings = swinging(GetParam(), 1e-3);
  settings.effects = {MovingPins{.pins = {10}, .keyframes = {{0, {0, 0, 0}}, {1, {0, 0, 1}}}, .release = 4 * h}};
  settings.cloth.pins = {0, 10};
  const double height = settings.cloth.positions(10, 2);
  Simulation simulation(settings);
  for (int i = 1; i <= 4; ++i) {
    const StepReport report = simulation.step();
    EXPECT_TRUE(report.converged);
    EXPECT_NEAR(simulation.state().x(10, 2), height + i * h, 1e-12);
  }
  EXPECT_EQ(simulation.cloth().pins.size(), 2U);
  simulation.step();
  EXPECT_EQ(simulation.cloth().pins, std::vector{0});
}

// Second-order schemes are exact in free fall; Euler's are g·h/2 too fast.
TEST_P(AskedAccuracy, AClothFallsWithoutError) {
  SimulationSettings settings = swinging(GetParam(), 0.02);
  settings.cloth.pins.clear();
  Simulation simulation(settings);
  const double start = settings.cloth.positions(0, 2);
  const StepReport report = simulation.step();
  const double fallen = start - simulation.state().x(0, 2), error = fallen - 0.5 * 9.8 * h * h;
  EXPECT_NEAR(error, 0, 1e-6 * h * h);
  EXPECT_NEAR(*report.estimate, 0, 1e-6 * h * h);
}

// A constant residual force in every substep of h/n moves a vertex by its tolerance·n²/2 in the step.
TEST_P(AskedAccuracy, TheSolvesLeaveOutATenthOfItAtMost) {
  if (GetParam().is_explicit()) GTEST_SKIP() << "nothing is solved";
  for (const double accuracy : {1e-3, 1e-5, 1e-7}) {
    Simulation simulation(swinging(GetParam(), accuracy));
    const StepReport report = simulation.step();
    const double tolerance = simulation.accuracy().value().tolerance, n = static_cast<double>(report.substeps);
    const double solved = 1 - std::sqrt(0.5);  // part of a substep solved at once: SDIRK2's stages
    EXPECT_LE(tolerance * n * n / (2 * solved * solved), 0.1 * accuracy * (1 + 1e-9)) << accuracy;
  }
}

// Each of SDIRK2's two stages is solved, so a step with more iterations than stages has a solve that needs several.
TEST_P(AskedAccuracy, AStepWhoseSolvesEndEarlySaysThatItHasNotConverged) {
  if (GetParam().is_explicit()) GTEST_SKIP() << "nothing is solved";
  SimulationSettings settings = swinging(GetParam(), 1e-2, 18000);
  settings.cloth.velocities = random_vertices(settings.cloth.vertex_count(), 1);
  Simulation whole(settings);
  settings.integrator.max_iterations = 1;
  Simulation ended(settings);
  int ended_early = 0;
  for (int i = 0; i < 20; ++i) {
    ended.restore(whole.state());
    const StepReport report = whole.step();
    EXPECT_TRUE(report.converged);
    if (report.iterations <= 2 * report.substeps) continue;
    ++ended_early;
    EXPECT_FALSE(ended.step().converged) << "in step " << i;
  }
  EXPECT_GT(ended_early, 0);
}

TEST_P(AskedAccuracy, AtTheCapAStepSaysThatItHasNotConverged) {
  SimulationSettings settings = setup(cloth_of(make_grid(1, 1), 1, 1000, {0}), GetParam(), h);
  settings.cloth.velocities = random_vertices(4, 1);
  settings.effects = {Gravity{}};
  settings.integrator.stop.reset();
  settings.integrator.tolerance.reset();
  settings.accuracy = 1e-25;
  Simulation simulation(settings);
  const StepReport report = simulation.step();
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.substeps, 4096);
  EXPECT_GT(report.estimate, 1e-25);
}

/// Least number of evaluations of the forces or of g in a motion: one per substep of an explicit method, in all
/// attempts; otherwise one per iteration, one per start of a substep, and three for a default step's possible starts.
/// Error: distance of its end from the reference.
struct Work {
  double evaluations, error;
};

Work work_of(const SimulationSettings& settings, double time, const Vertices& reference) {
  std::int64_t looks = 0;  // one in every step, and in every substep of an explicit method
  Simulation simulation(settings, Timing::none, Stop([&] {
                          ++looks;
                          return false;
                        }));
  Work work{0, 0};
  for (auto left = std::llround(time / settings.step); left > 0; --left) {
    const StepReport report = simulation.step();
    work.evaluations += report.iterations + (settings.accuracy ? static_cast<double>(report.substeps) : 3);
  }
  if (is_explicit(settings.integrator.method)) work.evaluations = static_cast<double>(looks);
  work.error = largest(simulation.state().x, reference);
  return work;
}

/// Returns the work of fixed steps of h and its halves, from the longest that the method may take.
std::vector<Work> work_of_fixed_steps(const NamedMethod& method, double time, const Vertices& reference) {
  std::vector<Work> fixed;
  for (int halvings = 0; halvings <= 7; ++halvings) {
    SimulationSettings settings = swinging(method, 1);
    settings.accuracy.reset();
    settings.step = std::ldexp(h, -halvings);
    if (method.is_explicit() && settings.step > safe_step(make_system(settings))) continue;
    fixed.push_back(work_of(settings, time, reference));
  }
  return fixed;
}

// A manual search finds a point on the line through fixed steps that are halved repeatedly.
TEST_P(AskedAccuracy, AtEqualErrorItTakesAtMostHalfAsManyEvaluationsAgainAsTheBestFixedStep) {
  constexpr double time = 15 * h;
  SimulationSettings exact = swinging(Method::verlet, 1);
  exact.accuracy.reset();
  exact.step = h / 512;
  Simulation small(exact);
  for (int i = 0; i < 512 * 15; ++i) small.step();
  const Vertices reference = small.state().x;
  const std::vector<Work> fixed = work_of_fixed_steps(GetParam(), time, reference);
  for (const double accuracy : {1e-2, 1e-3, 1e-4}) {
    const Work asked = work_of(swinging(GetParam(), accuracy), time, reference);
    double best = INFINITY;
    for (std::size_t i = 0; i < fixed.size(); ++i) {
      if (fixed[i].error <= asked.error) best = std::min(best, fixed[i].evaluations);
      if (i + 1 == fixed.size() || !(fixed[i].error > asked.error && asked.error > fixed[i + 1].error)) continue;
      const double part = std::log(fixed[i].error / asked.error) / std::log(fixed[i].error / fixed[i + 1].error);
      const double more = fixed[i + 1].evaluations / fixed[i].evaluations;
      best = std::min(best, fixed[i].evaluations * std::pow(more, part));
    }
    // A first-order method may not reach that error at all.
    if (GetParam().second_order()) {
      EXPECT_LT(best, INFINITY);
    }
    EXPECT_LE(asked.evaluations, 1.5 * best) << "accuracy " << accuracy << ", error " << asked.error;
  }
}

class AskedExplicitly : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, AskedExplicitly, testing::ValuesIn(explicit_methods), method_name);

TEST_P(AskedExplicitly, AStepBeyondTheSafeOneRuns) {
  SimulationSettings settings = swinging(GetParam(), 1, 1e5);  // an accuracy without effect
  const double safe = safe_step(make_system(settings));
  ASSERT_GT(h, 50 * safe);
  Simulation simulation(settings);
  for (int i = 0; i < 10; ++i) {
    const StepReport report = simulation.step();
    EXPECT_LE(h / static_cast<double>(report.substeps), safe);
    EXPECT_TRUE(report.converged);
  }
  settings.accuracy.reset();
  EXPECT_THROW(Simulation{settings}, UsageError);
}

// The number of substeps that a step needs changes slowly, so few attempts fail if a step begins with the last number.
TEST_P(AskedExplicitly, TheNumberOfSubstepsInTheStateSavesWork) {
  const auto substeps_done = [](bool forgotten) {
    std::int64_t looks = 0;
    Simulation simulation(swinging(GetParam(), 1e-5), Timing::none, Stop([&] {
                            ++looks;
                            return false;
                          }));
    for (int i = 0; i < 15; ++i) {
      simulation.step();
      State state = simulation.state();
      EXPECT_GT(state.substeps, 0);
      if (forgotten) state.substeps = 0;
      simulation.restore(state);
    }
    return looks;
  };
  EXPECT_LT(static_cast<double>(substeps_done(false)), 0.9 * static_cast<double>(substeps_done(true)));
}

double energy_of(const Simulation& simulation) {
  const State& state = simulation.state();
  double energy = 0.5 * (simulation.cloth().masses.array() * state.v.rowwise().squaredNorm().array()).sum();
  for (const Spring& spring : simulation.cloth().springs) {
    const double stretch = (state.x.row(spring.i) - state.x.row(spring.j)).norm() - spring.rest_length;
    energy += 0.5 * spring.stiffness * stretch * stretch;
  }
  return energy;
}

// Symplectic steps conserve an energy that differs from the springs' in proportion to their length. If one mode gained
// only a hundredth per step, the energy would have doubled many times by the end.
TEST_P(AskedExplicitly, NothingMakesUndampedSpringsSwingMoreAndMore) {
  for (const double stiffness : {180., 1800., 5000.}) {
    SimulationSettings settings = swinging(GetParam(), 1, stiffness);  // the longest stable steps
    settings.effects = {};
    settings.cloth.pins.clear();
    settings.cloth.positions += 0.02 * random_vertices(settings.cloth.vertex_count(), 3);
    Simulation simulation(settings);
    const double start = energy_of(simulation);
    double most = 0;
    for (int i = 0; i < 2000; ++i) {
      simulation.step();
      most = std::max(most, energy_of(simulation));
    }
    EXPECT_LT(most, 1.5 * start) << stiffness;
  }
}

}  // namespace
}  // namespace drape::test::asked_accuracy
