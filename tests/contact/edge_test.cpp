// Cloth that hangs over the edges of a box: its vertices keep the distance from the box, and its edges a quarter of it.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/contact/contact_setup.hpp"

namespace drape::test {
namespace {

using Eigen::Vector3d;

class OverAnEdge : public Solved {};
INSTANTIATE_TEST_SUITE_P(With, OverAnEdge, testing::ValuesIn(contact_methods), method_name);

const Vector3d half_box(0.15, 0.15, 0.1);

/// Returns the signed distance from a box around the origin [m].
double from_box(const Vector3d& point) {
  const Vector3d beyond = point.cwiseAbs() - half_box;
  return beyond.cwiseMax(0).norm() + std::min(0.0, beyond.maxCoeff());
}

struct Clearance {
  double vertices, edges;  // least distances [m]
};

Clearance clearance(const Cloth& cloth, const Vertices& x) {
  constexpr int parts = 50;
  Clearance least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (const Triangle& t : cloth.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector3d from = x.row(t[c]).transpose(), to = x.row(t[(c + 1) % 3]).transpose();
      least.vertices = std::min(least.vertices, from_box(from));
      for (int k = 0; k <= parts; ++k) least.edges = std::min(least.edges, from_box(from + (to - from) * k / parts));
    }
  }
  return least;
}

TEST_P(OverAnEdge, EdgesKeepAQuarterOfTheDistanceAndVerticesAll) {
  // The box's edges are below the middle of cells.
  SimulationSettings s = settings(plain_sheet(level_square(0.6, 6, half_box.z() + 2 * distance), 60), 0.005);
  s.effects.add(Body{.box = 2 * half_box, .center = Vector3d::Zero(), .thickness = distance});
  s = divided(s);
  Simulation simulation(s);
  double nearest = std::numeric_limits<double>::infinity();
  int converged = 0;
  for (int step = 0; step < 60; ++step) {
    if (!simulation.step().converged) continue;
    ++converged;
    const Clearance now = clearance(s.cloth, simulation.state().x);
    ASSERT_GE(now.vertices, 0.99 * distance) << "step " << step;
    ASSERT_GE(now.edges, 0.24 * distance) << "step " << step;
    nearest = std::min(nearest, now.edges);
  }
  EXPECT_GE(converged, 10);
  EXPECT_LT(nearest, 0.5 * distance) << "no edge reaches the box's";
}

}  // namespace
}  // namespace drape::test
