// Strain limits hold together with contact: a step reports whichever of both it cannot satisfy.

#include <gtest/gtest.h>

#include <algorithm>

#include "drape/sim/effects/damping.hpp"
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

// A limit is part of the solve: it and contact do not undo each other's work.
TEST_P(LimitsBesideContact, HardlyAnyStepIsLeftUnsolved) {
  const SimulationSettings s = crate();
  if (is_explicit(s.integrator.method) || s.integrator.method == Method::liu13) GTEST_SKIP() << "for Newton's Hessian";
  Simulation simulation(s);
  int unsolved = 0;
  for (int step = 0; step < 60; ++step) unsolved += simulation.step().converged ? 0 : 1;
  EXPECT_LE(unsolved, 3);
}

// The friction of a strip that hangs over an edge bears more than the part that hangs, whether or not a limit holds it.
TEST_P(LimitsBesideContact, FrictionHoldsAStripOverAnEdge) {
  Mesh mesh = make_grid(32, 3);
  mesh.positions.col(1) *= 0.1;
  mesh.positions.col(2).setConstant(distance);
  SimulationSettings s = settings(make_cloth(mesh, mesh, 0.1, 24, {}), 0.01);
  Body table = solved_box({2, 2, 1}, 0);
  table.center = Eigen::Vector3d(-0.6, 0, -0.5);
  table.friction = 0.8;
  s.effects.add(table);
  s.effects.add(Damping{.factor = 0.1});
  s.effects.add(StrainLimit{.max_stretch = 1.01, .tolerance = tolerance});
  s = divided(s);
  Simulation simulation(s);
  run(simulation, 2);
  const Vertices before = simulation.state().x;
  run(simulation, 3);
  EXPECT_LT((simulation.state().x - before).topRows(20).rowwise().norm().maxCoeff(), 2e-4);
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
