// Strain limits hold together with contact: a step reports whichever of both it cannot satisfy.

#include <gtest/gtest.h>

#include <algorithm>

#include "drape/sim/effects/strain_limit.hpp"
#include "tests/contact/contact_setup.hpp"
#include "tests/support/audited_run.hpp"

namespace drape::test {
namespace {

constexpr double limit = 1.05, tolerance = 1e-3;

class LimitsBesideContact : public Solved {
 protected:
  /// Makes a sheet that falls on a crate, and hangs from it onto itself and the ground.
  [[nodiscard]] SimulationSettings crate() const {
    SimulationSettings s = settings(plain_sheet(level_square(0.8, 12, 0.35), 20), 0.01);
    s.effects.add(solved_ground());
    s.effects.add(solved_box({0.4, 0.4, 0.3}, 0.3));
    s.effects.add(solved_self());
    s.effects.add(StrainLimit{.max_stretch = limit, .tolerance = tolerance});
    return divided(s);
  }
};
INSTANTIATE_TEST_SUITE_P(With, LimitsBesideContact, testing::ValuesIn(contact_methods), method_name);

double greatest_stretch(const Cloth& cloth, const Vertices& x) {
  double most = 0;
  for (const Spring& s : cloth.springs) most = std::max(most, (x.row(s.i) - x.row(s.j)).norm() / s.rest_length);
  return most;
}

TEST_P(LimitsBesideContact, NoEdgeExceedsItsLimitUnlessTheStepSaysSo) {
  const SimulationSettings s = crate();
  Simulation simulation(s);
  int held = 0;
  for (int step = 0; step < 60; ++step) {
    const bool converged = simulation.step().converged;
    const double stretch = greatest_stretch(s.cloth, simulation.state().x);
    if (converged) {
      ASSERT_LE(stretch, limit * (1 + tolerance) + 1e-9) << "step " << step;
    }
    if (stretch > limit * (1 - 1e-3)) ++held;
  }
  EXPECT_GT(held, 5) << "nothing is stretched so far";
}

TEST_P(LimitsBesideContact, NothingPassesAndNoEnergyIsGiven) {
  const SimulationSettings s = crate();
  const Energies start = Simulation(s).energies();
  const AuditedRun audited = audit_run(s, 60);
  EXPECT_EQ(audited.with_passages, 0) << lines(audited.first);
  EXPECT_EQ(audited.with_crossings, 0) << lines(audited.first);
  EXPECT_EQ(audited.deepest, 0);
  EXPECT_LE(audited.rise.rise, 0.01 * (start.kinetic + start.elastic + s.cloth.masses.sum() * g * 0.35));
}

}  // namespace
}  // namespace drape::test
