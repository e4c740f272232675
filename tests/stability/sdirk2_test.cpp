// SDIRK2 in hard cases. It is L-stable, but nothing bounds the energy of a step: measured limits, and detection of
// excess.

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

TEST_P(HardStages, EndInFiniteNumbersOrAreFoundOut) {
  const auto& [hard, method] = GetParam();
  const HardRun forced = load(hard, method, {"integrator.allow_unstable=true"});
  if (condition_bound(make_system(forced.settings)) > largest_condition)
    return;  // refused, as by every implicit method
  const HardRun given = load(hard, method);
  const StepLedger ledger(given.settings);
  const FloatingPointTraps traps;
  Simulation simulation(given.settings);
  const auto momentum = ledger.momentum(simulation.state());
  Real scale = 0;
  try {
    for (std::int64_t step = 0; step < std::min<std::int64_t>(given.steps, 40); ++step) {
      const StepReport report = simulation.step();
      ASSERT_TRUE(simulation.state().x.allFinite() && simulation.state().v.allFinite());
      EXPECT_LE(report.rise, 0) << "an iteration of a stage raised g in step " << step;
      scale = std::max(scale, ledger.momentum_scale(simulation.state()));
    }
  } catch (const DivergedError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("times the cloth's initial energy plus the work done on it; sdirk2 can gain energy"),
              std::string::npos)
        << message;
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
TEST_P(HangingStages, SolvedMuchTooLooselyAreFoundOut) {
  SimulationSettings settings = setup(cloth_of(make_grid(4, 4), 1, 1e8, {0, 4}), GetParam(), 5e-3);
  settings.effects = {Gravity{}};
  settings.integrator.stop = StoppingRule::change;
  settings.integrator.tolerance = 1e-3;
  Simulation simulation(settings);
  std::string message;
  const Energies start = simulation.energies();
  try {
    for (int step = 0; step < 300; ++step) simulation.step();
  } catch (const DivergedError& error) {
    EXPECT_EQ(error.kind(), ErrorKind::diverged);
    message = error.what();
  }
  if (GetParam().method == Method::implicit && message.empty())
    return;  // its last iteration changes far more than 1 mm
  EXPECT_NE(message.find("use a smaller tolerance"), std::string::npos) << message;
  const Energies now = simulation.energies();
  EXPECT_GT(now.kinetic + now.elastic, Sdirk2Guard::limit * (start.gravity - now.gravity));
}

}  // namespace
}  // namespace drape::test
