#include <gtest/gtest.h>

#include "sim/linear/newton_system.hpp"
#include "tests/support/matrices.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/plain_springs.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

/// x, y, z of vertex 0 first.
Eigen::VectorXd by_vertex(const Vertices& v) {
  const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> rows = v;
  return Eigen::Map<const Eigen::VectorXd>(rows.data(), rows.size());
}

/// ‖H p − b‖/‖b‖ over the free vertices.
double newton_residual(const System& system, const Vertices& x, const Vertices& direction, Vertices b) {
  for (const int pin : system.cloth.pins) b.row(pin).setZero();
  return (newton_matrix(system, x) * by_vertex(direction) - by_vertex(b)).norm() / b.norm();
}

TEST(NewtonSystem, SolvesWithStretchedAndCompressedSprings) {
  for (const Mesh& mesh : {make_grid(15, 15), irregular_mesh(12), three_sheets(7)}) {
    const Cloth cloth = cloth_of(mesh, 1, 180, {0, 7});
    const System system(cloth, 0.02);
    NewtonSystem newton(system);
    for (const int seed : {1, 2}) {  // the values may change
      const Vertices x = cloth.positions + 0.1 * random_vertices(cloth.vertex_count(), seed);
      const Vertices b = random_vertices(cloth.vertex_count(), 9);
      Vertices direction = Vertices::Constant(cloth.vertex_count(), 3, 99);
      newton.factorize(x);
      newton.solve(b, direction);
      EXPECT_LT(newton_residual(system, x, direction, b), 1e-12);
      for (const int pin : cloth.pins) EXPECT_EQ(direction.row(pin).norm(), 0);
    }
  }
}

// More than two thousand free vertices, where another kind of factor is faster.
TEST(NewtonSystem, SolvesForALargeCloth) {
  const Cloth cloth = cloth_of(make_grid(47, 45), 1, 180, {0, 47});
  const System system(cloth, 0.02);
  NewtonSystem newton(system);
  const Vertices x = cloth.positions + 0.02 * random_vertices(cloth.vertex_count(), 1);
  const Vertices b = random_vertices(cloth.vertex_count(), 2);
  Vertices direction(cloth.vertex_count(), 3);
  newton.factorize(x);
  newton.solve(b, direction);
  EXPECT_LT(newton_residual(system, x, direction, b), 1e-11);
}

// Where every spring is stretched, H is the derivative of the gradient, found here by central differences: wrong by
// ε² times the third derivatives of the gradient, and its rounding over ε.
TEST(NewtonSystem, IsTheDerivativeOfTheGradientWhereAllSpringsAreStretched) {
  const Cloth cloth = cloth_of(irregular_mesh(6), 1, 180, {0, 3});
  const System system(cloth, 0.02);
  const Vertices x = 1.5 * cloth.positions;
  NewtonSystem newton(system);
  newton.factorize(x);
  Vertices b = random_vertices(cloth.vertex_count(), 4), direction = b;
  newton.solve(b, direction);

  constexpr double epsilon = 1e-4;
  Vertices product = (cloth.masses / (0.02 * 0.02)).asDiagonal() * direction;
  product += (plain_gradient(cloth.springs, x + epsilon * direction) -
              plain_gradient(cloth.springs, x - epsilon * direction)) /
             (2 * epsilon);
  for (const int pin : cloth.pins) {
    product.row(pin).setZero();
    b.row(pin).setZero();
  }
  EXPECT_LT((product - b).norm(), 1e-7 * b.norm());
}

TEST(NewtonSystem, StaysPositiveDefiniteHoweverCompressed) {
  const Cloth cloth = cloth_of(make_grid(10, 10), 1, 1e6, {0});
  const System system(cloth, 0.1);
  NewtonSystem newton(system);
  Vertices b = random_vertices(cloth.vertex_count(), 4), direction = b;
  for (const double scale : {0.5, 1e-3, 0.0}) {  // at last all vertices in one place
    newton.factorize(scale * cloth.positions);
    newton.solve(b, direction);
    EXPECT_GT(b.bottomRows(120).cwiseProduct(direction.bottomRows(120)).sum(), 0) << "downhill";
    EXPECT_TRUE(direction.allFinite());
  }
}

TEST(NewtonSystem, OfAClothThatIsAllPinsGivesZero) {
  const Cloth cloth = cloth_of(make_grid(3, 3), 1, 180, every(16));
  const System system(cloth, 0.02);
  NewtonSystem newton(system);
  newton.factorize(cloth.positions);
  Vertices direction = Vertices::Constant(16, 3, 99);
  newton.solve(random_vertices(16, 1), direction);
  EXPECT_EQ(direction.norm(), 0);
}

}  // namespace
}  // namespace drape::test
