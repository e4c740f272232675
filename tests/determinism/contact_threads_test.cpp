#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

#include "sim/effects/self_collision.hpp"
#include "sim/simulation.hpp"
#include "tests/support/setups.hpp"

// What several threads find of contact, and what it does, has the bits of one, however many there are.

namespace drape::contact_threads {
using test::same_bits;
using test::setup;

namespace {

constexpr int cells = 92;  // enough vertices to be divided, and few more
constexpr int steps = 3;

Cloth flat_cloth() { return test::cloth_of(make_grid(cells, cells), 1, 180, {0, cells}); }

/// Four layers, each the half of its length in z and so much apart, that come together faster than a step keeps them
/// apart.
Cloth folded_cloth() {
  constexpr double layer = 0.5, gap = 0.012, speed = 2;  // [m, m, m/s]
  Cloth cloth = flat_cloth();
  for (Eigen::Index i = 0; i < cloth.positions.rows(); ++i) {
    const double along = cloth.rest(i, 0) - cloth.rest.col(0).minCoeff();
    const int number = std::min(3, static_cast<int>(along / layer));
    const double within = along - number * layer;
    cloth.positions(i, 0) = number % 2 == 0 ? within : layer - within;
    cloth.positions(i, 2) = gap * (number + within / layer);
    cloth.velocities.row(i) << 0.3 * number, 0, -speed * number;
  }
  return cloth;
}

State moved(SimulationSettings settings, int threads) {
  settings.threads = threads;
  Simulation simulation(settings);
  for (int step = 0; step < steps; ++step) simulation.step();
  return simulation.state();
}

/// Of a motion in which the last of its effects does something.
void expect_the_same_bits(SimulationSettings settings) {
  settings.integrator.max_iterations = 5;
  const State alone = moved(settings, 1);
  for (const int threads : {2, 3, 8}) {
    const State together = moved(settings, threads);
    EXPECT_TRUE(same_bits(together.x, alone.x)) << threads << " threads";
    EXPECT_TRUE(same_bits(together.v, alone.v)) << threads << " threads";
  }
  Effects others;
  for (std::size_t i = 0; i + 1 < settings.effects.size(); ++i) others.add(settings.effects[i]);
  settings.effects = others;
  EXPECT_GT((moved(settings, 1).x - alone.x).rowwise().norm().maxCoeff(), 1e-3) << "nothing touches";
}

TEST(ContactByThreads, OfAClothWithItselfHasTheSameBits) {
  SimulationSettings settings = setup(folded_cloth(), Method::liu13, 0.01);
  settings.effects = {Gravity{}, SelfCollision{.thickness = 0.01}};
  expect_the_same_bits(settings);
}

}  // namespace
}  // namespace drape::contact_threads
