// Free sheets of cloth that lie on each other come to rest. liu13, whose factor is constant, takes minutes for it.

#include <gtest/gtest.h>

#include "tests/contact/contact_setup.hpp"

namespace drape::test {
namespace {

class Pile : public Solved {};
INSTANTIATE_TEST_SUITE_P(Nightly, Pile,
                         testing::Values(contact_methods[0], contact_methods[2], contact_methods[3],
                                         contact_methods[4]),
                         method_name);

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

}  // namespace
}  // namespace drape::test
