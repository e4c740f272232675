// The implicit methods in hard cases: laws of every step, converged or not.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/stability.hpp"
#include "sim/system.hpp"
#include "tests/stability/hard_cases.hpp"
#include "tests/stability/traps.hpp"
#include "tests/support/step_ledger.hpp"
#include "tests/support/usage_error.hpp"

namespace drape::test {
namespace {

/// Extreme values of a run.
struct Record {
  Real growth = 0;            // largest Σ (ΔK + ΔE − W) at any time [J]
  Real largest_gain = 0;      // of a single step [J]
  Real highest = 0;           // K + E [J]
  Real momentum_scale = 0;    // largest Σ m ‖v‖ [kg m/s]
  double worst_residual = 0;  // of unconverged steps [N]
  int not_converged = 0;
};

class HardCases : public testing::TestWithParam<std::tuple<HardCase, NamedMethod>> {
 protected:
  static void check_step(const StepBalance& b, const Simulation& simulation, const Energies& before,
                         const StepReport& report) {
    ASSERT_TRUE(simulation.state().x.allFinite() && simulation.state().v.allFinite());
    // No iteration raised g, and the step ended no higher than it began.
    EXPECT_LE(report.rise, 0);
    EXPECT_LE(b.end_value, b.start_value + b.energy_rounding);
    // ∇g and the energies follow the formulas.
    EXPECT_NEAR(simulation.residual(), static_cast<double>(b.gradient_norm), static_cast<double>(b.gradient_rounding));
    const Energies after = simulation.energies();
    EXPECT_NEAR(after.elastic, static_cast<double>(b.elastic_after), static_cast<double>(b.energy_rounding));
    // The balance: ΔK and ΔE as the simulation reports them, the other side computed from the states.
    const Real others = (b.energy_after - b.elastic_after) - (b.energy_before - b.elastic_before);
    const Real change = Real(after.kinetic) - before.kinetic + after.elastic - before.elastic + others;
    const Real balance = b.work - b.inertial_loss - b.convexity_loss + b.imbalance;
    EXPECT_LE(std::abs(change - balance), b.gain_rounding())
        << static_cast<double>(change) << " J, and by the balance " << static_cast<double>(balance);
    // No energy gain.
    EXPECT_LE(b.gain(), (report.converged ? b.tolerated : 0) + b.gain_rounding());
  }

  static Record run(Simulation& simulation, const StepLedger& ledger, std::int64_t steps) {
    Record record;
    Real growth = 0;
    for (std::int64_t step = 0; step < steps && !HasFatalFailure(); ++step) {
      const State before = simulation.state();
      const Energies energies = simulation.energies();
      const StepReport report = simulation.step();
      const StepBalance b = ledger.balance(before, simulation.state());
      check_step(b, simulation, energies, report);
      growth += b.gain();
      record.growth = std::max(record.growth, growth);
      record.largest_gain = step == 0 ? b.gain() : std::max(record.largest_gain, b.gain());
      record.highest = std::max({record.highest, b.kinetic_before + b.energy_before, b.kinetic_after + b.energy_after});
      record.momentum_scale = std::max(record.momentum_scale, ledger.momentum_scale(simulation.state()));
      if (report.converged) continue;
      ++record.not_converged;
      record.worst_residual = std::max(record.worst_residual, simulation.residual());
    }
    return record;
  }
};
INSTANTIATE_TEST_SUITE_P(With, HardCases,
                         testing::Combine(testing::ValuesIn(hard_cases()), testing::ValuesIn(implicit_methods)),
                         case_and_method);

TEST_P(HardCases, ObeyTheLawsOfAStep) {
  const auto& [hard, method] = GetParam();
  const HardRun forced = load(hard, method, {"integrator.allow_unstable=true"});
  if (condition_bound(make_system(forced.settings)) > largest_condition) {
    const std::string refused =
        usage_error([&, &tested = hard, &with = method] { Simulation(load(tested, with).settings); });
    EXPECT_NE(refused.find("double precision leaves only rounding noise"), std::string::npos) << refused;
    return;
  }
  const HardRun given = load(hard, method);  // refused for that reason only
  const StepLedger ledger(given.settings);
  const FloatingPointTraps traps;
  Simulation simulation(given.settings);
  if (!make_system(given.settings).contacts.empty()) {  // the ledger does not know contact forces
    for (std::int64_t step = 0; step < given.steps; ++step) {
      simulation.step();
      ASSERT_TRUE(simulation.state().x.allFinite() && simulation.state().v.allFinite()) << "step " << step;
    }
    return;
  }
  const auto momentum = ledger.momentum(simulation.state());
  const Record record = run(simulation, ledger, given.steps);

  EXPECT_LE(record.growth, 1e-9 * record.highest)
      << "the cloth has had more energy than it had at first and was given; the largest gain of a step was "
      << static_cast<double>(record.largest_gain) << " J of " << static_cast<double>(record.highest) << " J";
  const bool pushed = !given.settings.effects.empty() || !given.settings.cloth.pins.empty();
  if (!pushed) {
    // Every step rounds the positions once, and a velocity is their difference over h.
    const double reach =
        simulation.state().x.cwiseAbs().maxCoeff() + given.settings.cloth.positions.cwiseAbs().maxCoeff();
    const Real mass = given.settings.cloth.masses.sum(), steps = static_cast<Real>(given.steps);
    const Real rounding = 8 * steps * unit * (record.momentum_scale + mass * reach / Real(given.settings.step));
    EXPECT_LE((ledger.momentum(simulation.state()) - momentum).norm(), rounding);
  }
  RecordProperty("largest_gain_J", std::to_string(static_cast<double>(record.largest_gain)));
  RecordProperty("steps_not_converged", record.not_converged);
  RecordProperty("worst_residual_N", std::to_string(record.worst_residual));
}

class HardCasesByDefault : public testing::TestWithParam<HardCase> {};
INSTANTIATE_TEST_SUITE_P(Case, HardCasesByDefault, testing::ValuesIn(hard_cases()),
                         [](const auto& hard) { return hard.param.name; });

TEST_P(HardCasesByDefault, GainNoEnergyOutOfNothing) {
  HardRun hard = load(GetParam(), Method::quasi_newton, {"integrator.allow_unstable=true"});
  hard.settings.integrator = {.method = Method::quasi_newton};
  if (condition_bound(make_system(hard.settings)) > largest_condition) return;
  if (!make_system(hard.settings).contacts.empty()) return;  // the ledger does not know contact forces
  const StepLedger ledger(hard.settings);
  const FloatingPointTraps traps;
  Simulation simulation(hard.settings);
  for (int step = 0; step < std::min<std::int64_t>(hard.steps, 30); ++step) {
    const State before = simulation.state();
    const StepReport report = simulation.step();
    const StepBalance b = ledger.balance(before, simulation.state());
    ASSERT_TRUE(simulation.state().x.allFinite() && simulation.state().v.allFinite());
    EXPECT_LE(report.rise, 0);
    EXPECT_LE(b.gain(), (report.converged ? b.tolerated : 0) + b.gain_rounding()) << "step " << step;
    // Convergence is confirmed by the residual forces, up to rounding.
    if (report.converged && condition_bound(make_system(hard.settings)) < 1e6) {
      EXPECT_LE(simulation.error(), 1.001 * ledger.tolerance(before, simulation.state())) << "step " << step;
    }
  }
}

}  // namespace
}  // namespace drape::test
