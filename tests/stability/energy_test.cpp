// Energy guarantee of the implicit methods for a hanging cloth, at the default tolerance and at the loosest.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "drape/sim/simulation.hpp"
#include "tests/support/methods.hpp"
#include "tests/support/setups.hpp"
#include "tests/support/step_ledger.hpp"

namespace drape::test {
namespace {

/// Energies of a cloth that fell from rest and then hung.
struct Fall {
  double above_start = 0;   // largest excess of K + E + gravity's energy over its initial value [J]
  double above_lowest = 0;  // largest excess over its lowest earlier value [J]
  double work = 0;          // largest work of gravity [J]
};

Fall fall(const SimulationSettings& settings, int steps) {
  Simulation simulation(settings);
  const auto total = [](const Energies& e) { return e.kinetic + e.elastic + e.gravity; };
  const Energies start = simulation.energies();
  Fall result;
  double lowest = total(start);
  for (int step = 0; step < steps; ++step) {
    simulation.step();
    const Energies now = simulation.energies();
    lowest = std::min(lowest, total(now));
    result.above_start = std::max(result.above_start, total(now) - total(start));
    result.above_lowest = std::max(result.above_lowest, total(now) - lowest);
    result.work = std::max(result.work, start.gravity - now.gravity);
  }
  return result;
}

/// Makes a cloth of 1 kg that hangs from two corners.
SimulationSettings hanging(Solver solver, int cells, double stiffness, double step) {
  SimulationSettings settings = setup(cloth_of(make_grid(cells, cells), 1, stiffness, {0, cells}), solver, step);
  settings.effects.add(Gravity{});
  return settings;
}

class HangingCloths : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, HangingCloths, testing::ValuesIn(implicit_methods), method_name);

TEST_P(HangingCloths, NeverHaveMoreEnergyThanTheyHadAndGravityGave) {
  for (const double stiffness : {1e5, 1e6, 1e7, 1e8}) {
    for (const double step : {1e-3, 5e-3, 1e-2, 2e-2}) {
      for (const int cells : {4, 8}) {
        const Fall fallen =
            fall(hanging(GetParam(), cells, stiffness, step), std::min(300, static_cast<int>(1.5 / step)));
        const std::string which = std::to_string(cells) + " cells, " + std::to_string(stiffness) + " N/m, " +
                                  std::to_string(step) + " s; gravity gave " + std::to_string(fallen.work) + " J";
        EXPECT_LE(fallen.above_start, 1e-3 * fallen.work) << which;
        // A step that meets its tolerance may gain a little, but not repeatedly.
        EXPECT_LE(fallen.above_lowest, 0.05 * fallen.work) << which;
      }
    }
  }
}

TEST_P(HangingCloths, GainNothingInTheLongRun) {
  const Fall fallen = fall(hanging(GetParam(), 4, 1e8, 5e-3), 3000);
  EXPECT_LE(fallen.above_start, 1e-3 * fallen.work);
  EXPECT_LE(fallen.above_lowest, 0.05 * fallen.work);
}

/// Returns the end of a step that is `factor` times as long as the given one.
State further(const State& before, const State& after, double factor) {
  State state = after;
  state.x = before.x + factor * (after.x - before.x);
  return state;
}

// A step that is cut back keeps the largest share without a gain: an eighth more would gain energy. The cloth starts
// with all of its allowed energy, so it is never stopped completely.
TEST_P(HangingCloths, KeepTheLargestShareOfAStepThatGainsNothing) {
  int cut = 0;
  for (const double stiffness : {1e6, 1e8}) {
    const SimulationSettings settings = hanging(GetParam(), 4, stiffness, 1e-2);
    Simulation simulation(settings);
    const StepLedger ledger(settings);
    for (int step = 0; step < 150; ++step) {
      const State before = simulation.state();
      const double kept = simulation.step().kept;
      if (kept == 1) continue;
      const State& after = simulation.state();
      const StepBalance b = ledger.balance(before, after);
      if (b.kinetic_before <= b.gain_rounding()) continue;
      ++cut;
      EXPECT_LE(b.gain(), b.gain_rounding()) << "step " << step << " at " << stiffness;
      ASSERT_GT(kept, 0) << "step " << step << " at " << stiffness;
      const double resolution = std::exp2(std::floor(std::log2(kept))) / 8;
      const StepBalance more = ledger.balance(before, further(before, after, (kept + resolution) / kept));
      EXPECT_GE(more.gain(), -more.gain_rounding()) << "step " << step << " at " << stiffness << ": kept " << kept;
    }
  }
  if (GetParam().method == Method::liu13) {
    EXPECT_GT(cut, 10) << "nothing to cut back";
  }
}

// At any tolerance of the homework's cloth, the forces in it bound the gain of a step.
TEST_P(HangingCloths, AtAnyToleranceGainNoMoreThanIsTolerated) {
  for (const double tolerance : {1.0, 1e-2}) {
    SimulationSettings settings = homework(GetParam(), 0.02, 180);
    settings.integrator.tolerance = tolerance;
    Simulation simulation(settings);
    const StepLedger ledger(settings);
    Real growth = 0, highest = 0;
    for (int step = 0; step < 150; ++step) {
      const State before = simulation.state();
      const bool converged = simulation.step().converged;
      const StepBalance b = ledger.balance(before, simulation.state());
      EXPECT_LE(b.gain(), (converged ? b.tolerated : 0) + b.gain_rounding()) << "step " << step << " at " << tolerance;
      growth += b.gain();
      highest = std::max(highest, b.kinetic_after + b.energy_after);
      EXPECT_LE(growth, 1e-9 * highest) << "step " << step << " at " << tolerance;
    }
  }
}

}  // namespace
}  // namespace drape::test
