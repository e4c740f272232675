// Free sheets of cloth that fall or lie on each other.

#include <gtest/gtest.h>

#include "tests/contact/contact_setup.hpp"

namespace drape::test {
namespace {

class Pile : public Solved {};
INSTANTIATE_TEST_SUITE_P(Nightly, Pile,
                         testing::Values(contact_methods[0], contact_methods[2], contact_methods[3],
                                         contact_methods[4]),
                         method_name);

// liu13, whose factor is constant, takes minutes for it.
TEST_P(Pile, OfFiveSheetsRests) {
  std::vector<Mesh> sheets;
  for (int i = 0; i < 5; ++i) sheets.push_back(level_square(0.4, 6, (1.2 + 1.5 * i) * distance));
  SimulationSettings s = settings(plain_sheet(together(sheets)), 0.01);
  s.effects.add(solved_ground());
  s.effects.add(solved_self());
  Simulation simulation(s);
  run(simulation, 3);
  EXPECT_LT(rms_speed(simulation), 1e-4);
  EXPECT_NEAR(simulation.state().x.col(2).maxCoeff(), 5 * distance, 0.2 * distance);
}

class FallingPile : public Solved {};
INSTANTIATE_TEST_SUITE_P(With, FallingPile, testing::Values(contact_methods[3], contact_methods[4]), method_name);

// Impulses pass through a pile one sheet per pass, more slowly than it falls upon the ground.
TEST_P(FallingPile, KeepsItsSheetsApartOrReportsTheStep) {
  constexpr int layers = 40;
  std::vector<Mesh> sheets;
  for (int i = 0; i < layers; ++i) sheets.push_back(level_square(0.1, 1, (1.1 + 1.05 * i) * distance));
  SimulationSettings s = settings(plain_sheet(together(sheets), 18), 0.005);
  s.cloth.velocities = Eigen::RowVector3d(0, 0, -5).replicate(s.cloth.vertex_count(), 1);
  s.effects.add(solved_ground());
  s.effects.add(solved_self());
  Simulation simulation(s);
  double before = distance;
  for (int step = 0; step < 40; ++step) {
    const bool converged = simulation.step().converged;
    const Eigen::VectorXd z = simulation.state().x.col(2);
    double gap = z.head(4).minCoeff();
    for (int i = 1; i < layers; ++i) gap = std::min(gap, (z.segment<4>(4 * i) - z.segment<4>(4 * i - 4)).minCoeff());
    if (converged) {
      EXPECT_GE(gap, before - 0.02 * distance) << "step " << step;
    }
    before = std::min(gap, distance);
  }
}

}  // namespace
}  // namespace drape::test
