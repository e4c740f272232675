// Solved contact has the same bits on every run and with any number of threads.

#include <gtest/gtest.h>

#include "tests/contact/contact_setup.hpp"

namespace drape::test {
namespace {

class Bits : public Solved {};
INSTANTIATE_TEST_SUITE_P(With, Bits, testing::ValuesIn(contact_methods), method_name);

/// Makes a sheet on a box and the ground, with a folded hem that comes down on it.
Cloth folded(int cells) {
  const Mesh rest = level_square(1, cells, 0);
  Mesh start = rest;
  start.positions.col(2).setConstant(distance + 0.002);
  for (Eigen::Index i = 0; i < start.positions.rows(); ++i) {
    const double beyond = rest.positions(i, 0) - 0.3;
    if (beyond <= 0) continue;
    start.positions(i, 0) = 0.3 - beyond;
    start.positions(i, 2) += 0.02;
  }
  Cloth cloth = make_cloth(start, rest, 0.2, 180, {});
  cloth.velocities.col(2).setConstant(-1);
  return cloth;
}

State moved(SimulationSettings settings, int threads) {
  settings.threads = threads;
  Simulation simulation(settings);
  simulation.step();
  return simulation.state();
}

TEST_P(Bits, AreThoseOfOneThreadAndOfTheRunBefore) {
  SimulationSettings s = settings(folded(92), 0.005);
  s.integrator.max_iterations = 2;
  s.effects.add(solved_ground());
  s.effects.add(solved_box({0.3, 0.3, 0.2}, 0.0015));
  s.effects.add(SelfCollision{.thickness = 0.004});
  const State first = moved(s, 1);
  EXPECT_GT(first.v.col(2).maxCoeff(), -0.9) << "nothing touches";
  for (const int threads : {1, 2, 3}) {
    const State again = moved(s, threads);
    EXPECT_TRUE(same_bits(again.x, first.x)) << threads;
    EXPECT_TRUE(same_bits(again.v, first.v)) << threads;
  }
}

}  // namespace
}  // namespace drape::test
