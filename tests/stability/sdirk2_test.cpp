// SDIRK2 in hard cases. It is L-stable, but not algebraically: backward Euler redoes steps that gain energy.

#include <gtest/gtest.h>

#include <algorithm>

#include "drape/sim/effects/acceleration.hpp"
#include "sim/schemes/implicit_schemes.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"
#include "tests/stability/hard_cases.hpp"
#include "tests/stability/traps.hpp"
#include "tests/support/setups.hpp"
#include "tests/support/step_ledger.hpp"

namespace drape::test {
namespace {

class HardStages : public testing::TestWithParam<std::tuple<HardCase, NamedMethod>> {};
INSTANTIATE_TEST_SUITE_P(With, HardStages,
                         testing::Combine(testing::ValuesIn(hard_cases()), testing::ValuesIn(sdirk2_methods)),
                         case_and_method);

// Steps may gain a twentieth of the energy that the motion was given; those that would gain more are redone.
TEST_P(HardStages, EndInFiniteNumbersAndGainLittle) {
  const auto& [hard, method] = GetParam();
  const HardRun forced = load(hard, method, {"integrator.allow_unstable=true"});
  const System system = make_system(forced.settings);
  if (condition_bound(system) > largest_condition) return;  // refused, as by every implicit method
  const bool is_watched = system.pin_motions.empty() && system.filters.empty() && system.contacts.empty();
  const HardRun given = load(hard, method);
  const StepLedger ledger(given.settings);
  const FloatingPointTraps traps;
  Simulation simulation(given.settings);
  const auto momentum = ledger.momentum(simulation.state());
  const auto energy = [&] {
    const Energies now = simulation.energies();
    return now.kinetic + now.elastic;
  };
  Real scale = 0, explained = energy();
  for (std::int64_t step = 0; step < std::min<std::int64_t>(given.steps, 40); ++step) {
    const State before = simulation.state();
    const double start = energy();
    const StepReport report = simulation.step();
    ASSERT_TRUE(simulation.state().x.allFinite() && simulation.state().v.allFinite());
    EXPECT_LE(report.rise, 0) << "an iteration of a stage raised g in step " << step;
    scale = std::max(scale, ledger.momentum_scale(simulation.state()));
    const Real work = ledger.work_at(0.5, before, simulation.state());
    explained += work;
    if (!is_watched) continue;
    const Real by_euler = report.redone ? ledger.balance(before, simulation.state()).tolerated : 0;
    EXPECT_LE(energy() - start - work, 0.0501L * explained + by_euler + ledger.resting_energy()) << "step " << step;
  }
  if (given.settings.effects.empty() && given.settings.cloth.pins.empty()) {
    const double reach =
        simulation.state().x.cwiseAbs().maxCoeff() + given.settings.cloth.positions.cwiseAbs().maxCoeff();
    const Real mass = given.settings.cloth.masses.sum(), steps = static_cast<Real>(given.steps);
    const Real rounding = 64 * steps * unit * (scale + mass * reach / Real(given.settings.step));
    EXPECT_LE((ledger.momentum(simulation.state()) - momentum).norm(), rounding);
  }
}

/// Returns the greatest K + E of a hanging cloth, relative to the work of gravity.
double highest(const SimulationSettings& settings, int steps) {
  Simulation simulation(settings);
  const Energies start = simulation.energies();
  double most = 0, given = 0;
  for (int step = 0; step < steps; ++step) {
    simulation.step();
    const Energies now = simulation.energies();
    given = std::max(given, start.gravity - now.gravity);
    most = std::max(most, (now.kinetic + now.elastic) / given);
  }
  return most;
}

class HangingStages : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, HangingStages, testing::ValuesIn(sdirk2_methods), method_name);

TEST_P(HangingStages, SolvedTightlyHaveNoMoreEnergyThanGravityGave) {
  for (const double stiffness : {1e2, 1e4, 1e6}) {
    for (const double step : {1e-3, 5e-3, 2e-2}) {
      SimulationSettings settings = setup(cloth_of(make_grid(4, 4), 1, stiffness, {0, 4}), GetParam(), step);
      settings.effects = {Gravity{}};
      settings.integrator.tolerance = 1e-9;
      settings.integrator.max_iterations = 5000;
      EXPECT_LE(highest(settings, std::min(300, static_cast<int>(1.5 / step))), 1.001) << stiffness << ", " << step;
    }
  }
}

// A rule that stops at a change of 1 mm leaves springs of 10⁸ N/m with 50 J each.
TEST_P(HangingStages, SolvedMuchTooLooselyAreRedone) {
  SimulationSettings settings = setup(cloth_of(make_grid(4, 4), 1, 1e8, {0, 4}), GetParam(), 5e-3);
  settings.effects = {Gravity{}};
  settings.integrator.stop = StoppingRule::change;
  settings.integrator.tolerance = 1e-3;
  Simulation simulation(settings);
  const Energies start = simulation.energies();
  int redone = 0;
  double given = 0;
  for (int step = 0; step < 300; ++step) {
    redone += simulation.step().redone ? 1 : 0;
    const Energies now = simulation.energies();
    given = std::max(given, start.gravity - now.gravity);
    ASSERT_LE(now.kinetic + now.elastic, 1.06 * given) << "step " << step;
  }
  const bool far_more_precise = GetParam().method == Method::implicit;  // Newton's last iteration
  EXPECT_TRUE(redone > 0 || far_more_precise);
}

// A stiff cloth in a heap springs apart within a step.
TEST_P(HangingStages, OfACrumpledClothHaveNoMoreEnergyThanItHad) {
  for (const double stiffness : {1e2, 1e4, 1e6}) {
    for (const double step : {1e-2, 0.1, 1.0}) {
      SimulationSettings settings = setup(cloth_of(make_grid(6, 6), 1, stiffness, {}), GetParam(), step);
      settings.cloth.positions = 1e-3 * random_vertices(settings.cloth.vertex_count(), 4);
      Simulation simulation(settings);
      const double had = simulation.energies().elastic;
      for (int i = 0; i < 60; ++i) {
        simulation.step();
        const Energies now = simulation.energies();
        ASSERT_LE(now.kinetic + now.elastic, 1.051 * had) << stiffness << ", " << step << ", step " << i;
      }
    }
  }
}

TEST_P(HangingStages, OfTheHomeworkAreNeverRedone) {
  SimulationSettings settings = homework(GetParam(), 0.01, 180);
  settings.integrator.max_iterations = 1000;
  Simulation simulation(settings);
  for (int step = 0; step < 300; ++step) ASSERT_FALSE(simulation.step().redone) << "step " << step;
}

}  // namespace
}  // namespace drape::test
