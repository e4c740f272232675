#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/plain_springs.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

class Accuracy : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, Accuracy, testing::ValuesIn(all_methods), method_name);

/// Makes a cloth stretched by a tenth and pinned at its corners: its motion is smooth, because no spring ever slackens.
Cloth taut_cloth() {
  const Mesh rest = make_grid(4, 4);
  Mesh start = rest;
  start.positions *= 1.1;
  for (int i = 0; i < 25; ++i) start.positions(i, 2) = 0.05 * std::cos(start.positions(i, 0));
  return make_cloth(start, rest, 1, 2, {0, 4, 20, 24});
}

TEST_P(Accuracy, ErrorHasTheOrderOfTheScheme) {
  constexpr double duration = 0.2, damping = 0.2;
  const Eigen::Vector3d gravity(0, 0, -9.8), wind(1, 2, 0.5);
  const Cloth cloth = taut_cloth();
  const State exact = exact_motion(cloth, gravity + wind, damping, duration, 400);

  const auto error = [&](int steps) {
    SimulationSettings settings = setup(cloth, GetParam(), duration / steps);
    settings.integrator.stop = StoppingRule::gradient;
    settings.integrator.tolerance = 1e-8;
    settings.integrator.max_iterations = 1000;
    settings.effects = {Gravity{}, Wind{.acceleration = wind}, Damping{.factor = damping}};
    Simulation simulation(settings);
    for (int step = 0; step < steps; ++step) simulation.step();
    return (simulation.state().x - exact.x).norm();
  };
  // The error is c₁h + c₂h² + … with both Euler schemes, and has no c₁ with the others. The frequencies of this cloth
  // are at most 20/s, so at h = 1 ms each term is a few per cent of the previous one and changes the order by as much.
  const double coarse = error(200), fine = error(400);
  const double expected = GetParam().second_order() ? 2 : 1;
  EXPECT_NEAR(std::log2(coarse / fine), expected, 0.1);
  EXPECT_LT(fine, GetParam().second_order() ? 2e-5 : 0.02);
}

class Dissipation : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, Dissipation, testing::ValuesIn(implicit_methods), method_name);

/// Makes a cloth stretched by a half and pinned along its whole border.
Cloth drum() {
  constexpr int n = 6;
  const Mesh rest = make_grid(n, n);
  Mesh start = rest;
  start.positions *= 1.5;
  std::vector<int> border;
  for (int i = 0; i < rest.positions.rows(); ++i) {
    if (rest.positions.row(i).cwiseAbs().maxCoeff() == 1) border.push_back(i);
  }
  Cloth cloth = make_cloth(start, rest, 1, 18, border);
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    cloth.velocities.row(i) << 0.3 * std::sin(i), 0.4 * std::cos(2 * i), std::sin(3 * i);
  }
  return cloth;
}

// While every spring is stretched E is convex, E(x) ≥ E(x') + ∇E(x')·(x − x'). A step of implicit Euler, where
// ∇E(x') = −M(v' − v)/h on the free vertices, then loses at least the energy ‖v' − v‖²_M/2.
TEST_P(Dissipation, IsAtLeastTheEnergyOfTheChangeOfVelocity) {
  SimulationSettings settings = setup(drum(), GetParam(), 0.02);
  settings.integrator.stop = StoppingRule::gradient;
  settings.integrator.tolerance = 1e-9;
  settings.integrator.max_iterations = 1000;
  Simulation simulation(settings);
  for (int step = 0; step < 50; ++step) {
    const State before = simulation.state();
    const double total = simulation.energies().total();
    simulation.step();
    const State& after = simulation.state();
    for (const Spring& s : settings.cloth.springs) {
      ASSERT_GT((after.x.row(s.i) - after.x.row(s.j)).norm(), s.rest_length) << "the test's setup is not taut";
    }
    const double lost = 0.5 * settings.cloth.masses.dot((after.v - before.v).rowwise().squaredNorm());
    EXPECT_LE(simulation.energies().total() + lost, total + 1e-9) << "in step " << step;
  }
}

}  // namespace
}  // namespace drape::test
