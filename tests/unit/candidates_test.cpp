// Searches with one object, one after the other.

#include "sim/collision/candidates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/meshes.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

// Earlier searches do not affect the result: for a cloth that moves slowly or fast, rigidly or not, with a single
// moving vertex, jumps, or another reach.
TEST(CollisionCandidates, AreThoseOfANewSearchWhateverWasSearchedForBefore) {
  const Cloth cloth = cloth_of(irregular_mesh(7), 1, 1, {3, 4, 5, 6});
  const auto count = static_cast<std::size_t>(cloth.vertex_count());
  const Vertices crumple = random_vertices(cloth.vertex_count(), 3);
  Random random;
  CollisionCandidates candidates(cloth);
  std::size_t found = 0;
  for (int motion = 0; motion < tries(100); ++motion) {
    std::vector<Point> from, way, to;
    const Point shift = 100 * random.between(-1, 1) * random_point(random);
    const Point together = random_point(random), jump = 0.1 * random_point(random);
    const double speed = std::pow(10, random.between(-5, -0.5)), reach = random.between(0.02, 0.1);
    for (std::size_t i = 0; i < count; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      from.emplace_back((cloth.positions.row(row) + 0.2 * crumple.row(row)).transpose() + shift);
      const bool stays = motion % 2 == 1 && i != static_cast<std::size_t>(motion) % count;
      way.emplace_back((stays ? 0 : speed) * random_point(random));
    }
    for (int step = 0; step < 6; ++step) {
      to = from;
      for (std::size_t i = 0; i < count; ++i) to[i] += way[i] + together;
      candidates.find(from, to, reach);
      CollisionCandidates anew(cloth);
      anew.find(from, to, reach);
      ASSERT_TRUE(candidates.pairs() == anew.pairs()) << "motion " << motion << ", step " << step;
      found += anew.pairs().size();
      for (std::size_t i = 0; i < count; ++i) {
        from[i] = to[i] + jump;
        way[i] += 0.1 * way[i].norm() * random_point(random);
      }
    }
  }
  EXPECT_GT(found, 1000U);
}

}  // namespace
}  // namespace drape::test
