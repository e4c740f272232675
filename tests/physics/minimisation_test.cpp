// Minimisation of the implicit step: always downhill, within its iterations, and honestly reported.

#include <gtest/gtest.h>

#include <vector>

#include "drape/sim/simulation.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/plain_springs.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

class Minimisation : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, Minimisation, testing::ValuesIn(implicit_methods), method_name);

/// One step's problem under a uniform acceleration [m/s²], written plainly: g(x) = 1/(2h²)‖x − y‖²_M + E(x).
struct Problem {
  Cloth cloth;
  double h;
  Vertices y;

  Problem(const SimulationSettings& settings, const State& state, const Eigen::RowVector3d& acceleration = {0, 0, -9.8})
      : cloth(settings.cloth), h(settings.step), y(state.x + settings.step * state.v) {
    y.rowwise() += h * h * acceleration;
    for (const int pin : cloth.pins) y.row(pin) = state.x.row(pin);
  }
  double value(const Vertices& x) const {
    return cloth.masses.dot((x - y).rowwise().squaredNorm()) / (2 * h * h) + plain_energy(cloth.springs, x);
  }
  double gradient_norm(const Vertices& x) const {
    Vertices gradient = cloth.masses.asDiagonal() * (x - y) / (h * h) + plain_gradient(cloth.springs, x);
    for (const int pin : cloth.pins) gradient.row(pin).setZero();
    return gradient.norm();
  }
};

/// Result of some iterations of a step from a state.
struct Outcome {
  State state;
  StepReport report;
  double residual;
};
Outcome iterate(SimulationSettings settings, const State& from, int max_iterations) {
  settings.integrator.max_iterations = max_iterations;
  Simulation simulation(std::move(settings));
  simulation.restore(from);
  const StepReport report = simulation.step();
  return {simulation.state(), report, simulation.residual()};
}

/// Makes settings of the homework's cloth with a tolerance that is never met.
SimulationSettings endless(Solver solver, double stiffness) {
  SimulationSettings settings = homework(solver, 0.02, stiffness);
  settings.integrator.stop = StoppingRule::gradient;
  settings.integrator.tolerance = 1e-300;
  return settings;
}

State after(int steps, double stiffness) {
  Simulation motion(homework(Method::liu13, 0.02, stiffness));
  while (motion.state().step < steps) motion.step();
  return motion.state();
}

TEST_P(Minimisation, NeverGoesUphill) {
  for (const double stiffness : {18.0, 1800.0}) {
    for (const int step : {5, 60}) {
      const SimulationSettings settings = endless(GetParam(), stiffness);
      const State start = after(step, stiffness);
      const Problem problem(settings, start);
      double before = problem.value(problem.y);
      bool arrived = false;
      for (int iterations = 1; iterations <= 10; ++iterations) {
        const Outcome outcome = iterate(settings, start, iterations);
        EXPECT_LE(outcome.report.rise, 0);
        if (outcome.report.kept < 1) continue;  // reduced because the last iterate had too much energy
        const double now = problem.value(outcome.state.x);
        // A sum of 1700 positive terms is far more accurate than 1e-13.
        EXPECT_LE(now, before * (1 + 1e-13))
            << "iteration " << iterations << " from step " << step << " at " << stiffness << " N/m";
        before = now;
        arrived = true;
      }
      if (arrived) {
        EXPECT_LT(before, problem.value(problem.y)) << "got nowhere";
      }
    }
  }
}

// Taut springs this stiff are soft across and hard once they turn: a full Newton step overshoots.
TEST_P(Minimisation, NeverGoesUphillWhereAFullStepWould) {
  for (int seed = 1; seed <= 10; ++seed) {
    SimulationSettings settings = setup(cloth_of(make_grid(1, 1), 1, 1e6, {0, 1}), GetParam(), 0.1);
    settings.cloth.velocities = 10 * random_vertices(4, seed);
    settings.integrator.stop = StoppingRule::gradient;
    settings.integrator.tolerance = 1e-300;
    const State start = Simulation(settings).state();
    const Problem problem(settings, start, {0, 0, 0});
    double before = problem.value(problem.y), lowest = before;
    for (int iterations = 1; iterations <= 10; ++iterations) {
      const Outcome outcome = iterate(settings, start, iterations);
      EXPECT_LE(outcome.report.rise, 0);
      lowest = std::min(lowest, problem.value(outcome.state.x));
      if (outcome.report.kept < 1) continue;
      const double now = problem.value(outcome.state.x);
      EXPECT_LE(now, before * (1 + 1e-13)) << "iteration " << iterations << ", velocities " << seed;
      before = now;
    }
    EXPECT_LT(lowest, 0.1 * problem.value(problem.y)) << "got nowhere, velocities " << seed;
  }
}

TEST_P(Minimisation, StopsAtItsCapAndSaysSo) {
  const SimulationSettings settings = endless(GetParam(), 180);
  const State start = after(30, 180);
  for (const int cap : {1, 2, 7}) {
    const StepReport report = iterate(settings, start, cap).report;
    EXPECT_EQ(report.iterations, cap);
    EXPECT_FALSE(report.converged);
  }
}

TEST_P(Minimisation, HasTheHomeworksCapsUnlessToldOtherwise) {
  SimulationSettings settings = endless(GetParam(), 180);
  Simulation simulation(settings);
  const StepReport report = simulation.step();
  EXPECT_FALSE(report.converged);
  if (GetParam().method == Method::implicit) {
    EXPECT_EQ(report.iterations, 20);
  } else if (GetParam().method == Method::liu13) {
    EXPECT_EQ(report.iterations, 100);
  }
}

TEST_P(Minimisation, ChangeRuleWaitsForTheSecondIteration) {
  SimulationSettings settings = homework(GetParam(), 0.02, 180);
  settings.integrator.tolerance = 1e6;
  Simulation simulation(settings);
  for (int step = 0; step < 5; ++step) {
    const StepReport report = simulation.step();
    EXPECT_EQ(report.iterations, 2);
    EXPECT_TRUE(report.converged);
  }
}

TEST_P(Minimisation, ChangeRuleMeasuresAllUnknownsTogether) {
  const State start = after(30, 180);
  SimulationSettings settings = endless(GetParam(), 180);
  settings.integrator.stop = StoppingRule::change;  // Newton's iterates depend on it
  std::vector<Vertices> iterates;
  for (int i = 1; i <= 8; ++i) iterates.push_back(iterate(settings, start, i).state.x);
  double smallest = (iterates[1] - iterates[0]).norm();
  for (std::size_t i = 2; i < iterates.size(); ++i) {
    const double change = (iterates[i] - iterates[i - 1]).norm();
    if (change >= 0.9 * smallest) continue;
    smallest = change;
    settings.integrator.tolerance = change * 1.01;
    EXPECT_EQ(iterate(settings, start, 100).report.iterations, static_cast<int>(i) + 1);
    settings.integrator.tolerance = change * 0.99;
    EXPECT_GT(iterate(settings, start, 100).report.iterations, static_cast<int>(i) + 1);
  }
}

TEST_P(Minimisation, GradientRuleKeepsItsPromise) {
  SimulationSettings settings = homework(GetParam(), 0.02, 180);
  settings.integrator.stop = StoppingRule::gradient;
  for (const double tolerance : {1e-1, 1e-3, 1e-5}) {
    settings.integrator.tolerance = tolerance;
    const State start = after(25, 180);
    const Outcome outcome = iterate(settings, start, 20'000);
    ASSERT_TRUE(outcome.report.converged);
    EXPECT_LT(outcome.residual, tolerance);
    // The residual is the norm of the gradient at the cloth's current position.
    EXPECT_NEAR(outcome.residual, Problem(settings, start).gradient_norm(outcome.state.x), 1e-9);
    // One iteration fewer would not have been enough.
    const Outcome shorter = iterate(settings, start, outcome.report.iterations - 1);
    EXPECT_FALSE(shorter.report.converged);
    EXPECT_GE(shorter.residual, tolerance);
  }
}

TEST_P(Minimisation, NeedsNoIterationWhereNothingPulls) {
  SimulationSettings settings = setup(cloth_of(make_grid(4, 4), 1, 180, {0}), GetParam(), 0.02);
  settings.integrator.stop = StoppingRule::gradient;
  Simulation simulation(settings);
  const StepReport report = simulation.step();
  EXPECT_EQ(report.iterations, 0);
  EXPECT_TRUE(report.converged);
}

TEST(SemiImplicit, HasNoIterationsAndNoResidual) {
  Simulation simulation(homework(Method::semi_implicit, 0.001, 180));
  const StepReport report = simulation.step();
  EXPECT_EQ(report.iterations, 0);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(simulation.residual(), 0);
}

}  // namespace
}  // namespace drape::test
