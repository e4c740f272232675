// Contact is independent of order: a symmetric setup stays symmetric, to the tolerance of the solves.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "drape/sim/mesh.hpp"
#include "tests/contact/contact_setup.hpp"

namespace drape::test {
namespace {

class Symmetry : public Solved {};
INSTANTIATE_TEST_SUITE_P(With, Symmetry, testing::ValuesIn(contact_methods), method_name);

/// Returns for each vertex its mirror image in the plane y = 0.
std::vector<int> mirrored(const Mesh& mesh) {
  const auto key = [](double x, double y) { return std::pair(std::lround(1e6 * x), std::lround(1e6 * y)); };
  std::map<std::pair<long, long>, int> numbers;
  for (int i = 0; i < static_cast<int>(mesh.positions.rows()); ++i) {
    numbers[key(mesh.positions(i, 0), mesh.positions(i, 1))] = i;
  }
  std::vector<int> others;
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    others.push_back(numbers.at(key(mesh.positions(i, 0), -mesh.positions(i, 1))));
  }
  return others;
}

/// Returns the largest distance of a vertex from the mirror image of its counterpart [m].
double asymmetry(const Vertices& x, const std::vector<int>& others) {
  double most = 0;
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const Eigen::RowVector3d other = x.row(others[static_cast<std::size_t>(i)]);
    most = std::max(most, (x.row(i) - Eigen::RowVector3d(other.x(), -other.y(), other.z())).norm());
  }
  return most;
}

TEST_P(Symmetry, AClothThatFallsOnABallStaysSymmetric) {
  Mesh mesh = make_grid({.columns = 10, .rows = 10, .pattern = GridPattern::x, .size = {{1, 1}}});
  mesh.positions.col(2).array() += 0.23;
  const std::vector<int> others = mirrored(mesh);
  SimulationSettings scene = settings(plain_sheet(mesh), 0.01);
  Sphere ball{.center = Eigen::Vector3d(0, 0, 0), .radius = 0.2};
  ball.thickness = distance;
  ball.friction = 0.4;
  scene.effects.add(ball);
  Simulation simulation(scene);
  double most = 0;
  for (int i = 0; i < 25; ++i) {
    simulation.step();
    most = std::max(most, asymmetry(simulation.state().x, others));
  }
  EXPECT_LT(most, 1e-5);
}

}  // namespace
}  // namespace drape::test
