// A flat cloth that drifts slowly gains no energy, however it lies in space. Bending adds large terms of either sign
// there, whose rounding the energy balance has to know.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "drape/sim/effects/bending.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/methods.hpp"
#include "tests/support/setups.hpp"
#include "tests/support/step_ledger.hpp"

namespace drape::test {
namespace {

class DriftingCloth : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, DriftingCloth, testing::ValuesIn(implicit_methods), method_name);

TEST_P(DriftingCloth, GainsNothingButRounding) {
  Mesh mesh = make_grid(17, 13);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  mesh.positions = (5 * mesh.positions * turn.transpose()).eval();
  SimulationSettings settings = setup(cloth_of(mesh, 0.8, 1000, {}), GetParam(), 0.01);
  settings.cloth.velocities.rowwise() += Eigen::RowVector3d(1e-8, 2e-8, 3e-8);
  settings.effects.add(Bending{.rigidity = WarpWeft{1e-3, 1e-3}, .cross_stiffness = 0.2});
  const StepLedger ledger(settings);
  Simulation simulation(settings);
  for (int step = 0; step < 30; ++step) {
    const State before = simulation.state();
    simulation.step();
    const StepBalance b = ledger.balance(before, simulation.state());
    ASSERT_LE(b.gain(), b.gain_rounding()) << "step " << step;
    ASSERT_LE(b.gain_rounding(), 1e-10) << "step " << step;  // far below one degree of bending
  }
}

}  // namespace
}  // namespace drape::test
