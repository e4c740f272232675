#include <gtest/gtest.h>

#include "drape/sim/mesh.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

/// Returns the mean number of flipped pairs over the report's 417 steps of Liu13, k = 180, h = 0.02 s.
double flipped_pairs_per_frame(double tolerance) {
  SimulationSettings settings = homework(Method::liu13, 0.02, 180);
  settings.integrator.tolerance = tolerance;
  Simulation simulation(settings);
  const FlippedPairs pairs(simulation.cloth().triangles);
  double total = 0;
  for (int step = 0; step < homework_steps; ++step) {
    simulation.step();
    total += pairs.count(simulation.state().x);
  }
  return total / homework_steps;
}

TEST(Liu13, SolvedLooselyFlipsTrianglesAndSolvedTightlyAlmostNone) {
  const double loose = flipped_pairs_per_frame(1e-1), middle = flipped_pairs_per_frame(1e-3),
               tight = flipped_pairs_per_frame(1e-4);
  RecordProperty("flipped_pairs_at_0.1", std::to_string(loose));
  RecordProperty("flipped_pairs_at_1e-3", std::to_string(middle));
  RecordProperty("flipped_pairs_at_1e-4", std::to_string(tight));
  EXPECT_GT(loose, 2);  // the report's code shows about 4
  EXPECT_LT(loose, 8);
  EXPECT_LE(middle, loose / 3);
  EXPECT_LT(tight, 0.1);
}

TEST(FlippedPairs, AFlatGridHasNoneAndAFoldedQuadHasOne) {
  const Mesh grid = make_grid(3, 3);
  EXPECT_EQ(FlippedPairs(grid.triangles).count(grid.positions), 0);
  Mesh quad = make_grid(1, 1);
  quad.positions.row(3) = quad.positions.row(0);  // folded along its diagonal
  EXPECT_EQ(FlippedPairs(quad.triangles).count(quad.positions), 1);
}

}  // namespace
}  // namespace drape::test
