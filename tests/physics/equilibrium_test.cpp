#include <gtest/gtest.h>

#include "drape/sim/simulation.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

/// Makes vertices one above the other, 1/4 m apart, joined by springs; the first is pinned.
Cloth chain(int springs, double mass, double stiffness) {
  Cloth cloth;
  const int count = springs + 1;
  cloth.positions = Vertices::Zero(count, 3);
  for (int i = 0; i < count; ++i) cloth.positions(i, 2) = -0.25 * i;
  cloth.velocities = Vertices::Zero(count, 3);
  cloth.masses.setConstant(count, mass);
  for (int i = 0; i < springs; ++i) {
    cloth.springs.push_back({.i = i, .j = i + 1, .rest_length = 0.25, .stiffness = stiffness});
  }
  cloth.pins = {0};
  return cloth;
}

class Equilibrium : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, Equilibrium, testing::ValuesIn(all_methods), method_name);

/// Expects that at rest every spring is extended by the weight below it over its stiffness.
void expect_hookes_law(int springs, Solver solver) {
  constexpr double mass = 0.1, stiffness = 50;
  SimulationSettings settings = setup(chain(springs, mass, stiffness), solver, 0.01);
  settings.integrator.stop = StoppingRule::gradient;
  settings.integrator.tolerance = 1e-12;
  settings.integrator.max_iterations = 1000;
  settings.effects = {Gravity{}, Damping{.factor = 1e-4}};
  Simulation simulation(settings);
  // The slowest mode of 5 springs has a period of 1 s, and loses a factor 1e-2 in each second.
  for (int step = 0; step < 1000; ++step) simulation.step();

  const Vertices& x = simulation.state().x;
  for (int i = 0; i < springs; ++i) {
    const double weight = (springs - i) * mass * 9.8;
    EXPECT_NEAR(x(i, 2) - x(i + 1, 2), 0.25 + weight / stiffness, 1e-11) << "spring " << i << " of " << springs;
  }
  EXPECT_LT(x.leftCols(2).cwiseAbs().maxCoeff(), 1e-15) << "left the vertical";
  EXPECT_LT(simulation.state().v.cwiseAbs().maxCoeff(), 1e-9);
}

TEST_P(Equilibrium, OfOneSpringIsItsWeightOverItsStiffness) { expect_hookes_law(1, GetParam()); }

TEST_P(Equilibrium, OfAChainIsTheWeightBelowOverTheStiffness) { expect_hookes_law(5, GetParam()); }

TEST_P(Equilibrium, OfARestingClothLastsForever) {
  SimulationSettings settings = setup(cloth_of(make_grid(5, 4), 1, 180, {3}), GetParam(), 0.005);
  Simulation simulation(settings);
  for (int step = 0; step < 100; ++step) simulation.step();
  EXPECT_LT((simulation.state().x - settings.cloth.positions).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace drape::test
