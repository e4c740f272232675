#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

class Pins : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, Pins, testing::ValuesIn(all_methods), method_name);

/// Makes a moving cloth with all effects, including moving pins.
SimulationSettings stormy_with_pins(Solver solver, std::vector<int> pins) {
  SimulationSettings settings = setup(cloth_of(make_grid(8, 8), 1, 50, std::move(pins)), solver, 0.005);
  Cloth& cloth = settings.cloth;
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    cloth.positions.row(i) += 0.05 * Eigen::RowVector3d(std::sin(i), std::cos(3 * i), std::sin(2 * i));
    cloth.velocities.row(i) << std::cos(i), std::sin(2 * i), 1;
  }
  settings.effects = {Gravity{}, Wind{.acceleration = {20, 5, 0}},
                      Sphere{.center = Eigen::Vector3d(0, 0, 0), .radius = 0.8}, Damping{.factor = 0.5}};
  return settings;
}

TEST_P(Pins, NeverMove) {
  const SimulationSettings settings = stormy_with_pins(GetParam(), {0, 8, 40, 41, 77});
  Simulation simulation(settings);
  for (int step = 0; step < 100; ++step) {
    simulation.step();
    for (const int pin : settings.cloth.pins) {
      ASSERT_TRUE(same_bits(simulation.state().x.row(pin), settings.cloth.positions.row(pin))) << "step " << step;
      ASSERT_EQ(simulation.state().v.row(pin).norm(), 0) << "step " << step;
    }
  }
  EXPECT_GT((simulation.state().x - settings.cloth.positions).norm(), 1) << "nothing moved at all";
}

TEST_P(Pins, HaveNoVelocityFromTheStart) {
  const Simulation simulation(stormy_with_pins(GetParam(), {3}));
  EXPECT_EQ(simulation.state().v.row(3).norm(), 0);
  EXPECT_GT(simulation.state().v.row(4).norm(), 0);
}

TEST_P(Pins, MayBeEveryVertex) {
  const SimulationSettings settings = stormy_with_pins(GetParam(), every(81));
  Simulation simulation(settings);
  for (int step = 0; step < 3; ++step) EXPECT_TRUE(simulation.step().converged);
  EXPECT_TRUE(same_bits(simulation.state().x, settings.cloth.positions));
}

TEST_P(Pins, MayLeaveOneVertexFree) {
  std::vector<int> all_but_one = every(81);
  all_but_one.erase(all_but_one.begin());
  const SimulationSettings settings = stormy_with_pins(GetParam(), all_but_one);
  Simulation simulation(settings);
  for (int step = 0; step < 3; ++step) simulation.step();
  EXPECT_GT((simulation.state().x - settings.cloth.positions).row(0).norm(), 1e-3);
  EXPECT_TRUE(same_bits(simulation.state().x.bottomRows(80), settings.cloth.positions.bottomRows(80)));
}

}  // namespace
}  // namespace drape::test
