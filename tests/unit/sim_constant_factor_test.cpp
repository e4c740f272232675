#include <gtest/gtest.h>

#include <vector>

#include "sim/linear/constant_factor.hpp"
#include "tests/support/matrices.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

/// ‖A x − b‖/‖b‖ over the free vertices.
double residual(const System& system, const Vertices& x, Vertices b) {
  for (const int pin : system.cloth.pins) b.row(pin).setZero();
  return (constant_matrix(system) * x - b).norm() / b.norm();
}

TEST(ConstantFactor, SolvesToItsPrecision) {
  for (const Mesh& mesh : {make_grid(20, 20), irregular_mesh(12), three_sheets(7)}) {
    const Cloth cloth = cloth_of(mesh, 1, 180, {0, 7});
    const System system(cloth, 0.02);
    const Vertices b = random_vertices(cloth.vertex_count(), 1);
    Vertices x = Vertices::Constant(cloth.vertex_count(), 3, 99);

    ConstantFactor doubles(system, Precision::double_precision);
    EXPECT_FALSE(doubles.single_precision());
    doubles.solve(b, x);
    EXPECT_LT(residual(system, x, b), 1e-12);
    for (const int pin : cloth.pins) EXPECT_EQ(x.row(pin).norm(), 0);

    // The condition of A is a few hundred here, and numbers in single precision are right to 6e-8.
    ConstantFactor singles(system, Precision::single_precision);
    EXPECT_TRUE(singles.single_precision());
    singles.solve(b, x);
    EXPECT_LT(residual(system, x, b), 1e-5);
    EXPECT_GT(residual(system, x, b), 1e-12) << "is this single precision?";
    for (const int pin : cloth.pins) EXPECT_EQ(x.row(pin).norm(), 0);
    EXPECT_TRUE(ConstantFactor(system, Precision::automatic).single_precision());
  }
}

TEST(ConstantFactor, SolvesForNumbersOfAnySize) {
  const Cloth cloth = cloth_of(make_grid(8, 8), 1, 180, {0, 8});
  const System system(cloth, 0.02);
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    ConstantFactor factor(system, precision);
    for (const double scale : {1e-200, 1e-50, 1e50, 1e200}) {
      Vertices b = scale * random_vertices(cloth.vertex_count(), 1);
      Vertices x(cloth.vertex_count(), 3);
      factor.solve(b, x);
      // Norms of such numbers leave the range of double precision themselves.
      EXPECT_LT(residual(system, x / scale, b / scale), 1e-5);
    }
    Vertices x = Vertices::Constant(cloth.vertex_count(), 3, 99);
    factor.solve(Vertices::Zero(cloth.vertex_count(), 3), x);
    EXPECT_EQ(x.norm(), 0);
  }
}

TEST(ConstantFactor, IgnoresWhatPullsAtPins) {
  const Cloth cloth = cloth_of(make_grid(8, 8), 1, 180, {0, 8, 40});
  const System system(cloth, 0.02);
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    ConstantFactor factor(system, precision);
    Vertices b = random_vertices(cloth.vertex_count(), 1);
    for (const int pin : cloth.pins) b.row(pin).setConstant(1e6);
    Vertices x(cloth.vertex_count(), 3);
    factor.solve(b, x);
    EXPECT_LT(residual(system, x, b), 1e-5);
  }
}

TEST(ConstantFactor, OfAClothThatIsAllPinsGivesZero) {
  const Cloth cloth = cloth_of(make_grid(3, 3), 1, 180, every(16));
  const System system(cloth, 0.02);
  for (const Precision precision : {Precision::automatic, Precision::single_precision, Precision::double_precision}) {
    ConstantFactor factor(system, precision);
    Vertices x = Vertices::Constant(16, 3, 99);
    factor.solve(random_vertices(16, 1), x);
    EXPECT_EQ(x.norm(), 0);
  }
}

TEST(ConstantFactor, SolvesForASingleFreeVertex) {
  std::vector<int> pins = every(16);
  pins.erase(pins.begin() + 5);
  const Cloth cloth = cloth_of(make_grid(3, 3), 1, 180, pins);
  const System system(cloth, 0.02);
  for (const Precision precision : {Precision::automatic, Precision::single_precision, Precision::double_precision}) {
    ConstantFactor factor(system, precision);
    const Vertices b = random_vertices(16, 1);
    Vertices x(16, 3);
    factor.solve(b, x);
    EXPECT_LT(residual(system, x, b), 1e-6);
  }
}

// With A's condition at 1e10 single precision has no correct digit left.
TEST(ConstantFactor, FallsBackToDoublePrecisionWhereSingleIsTooCoarse) {
  const Cloth cloth = cloth_of(make_grid(20, 20), 1, 1e9, {});
  const System system(cloth, 0.1);
  ConstantFactor factor(system, Precision::automatic);
  EXPECT_FALSE(factor.single_precision());
  // A translation is what such a matrix knows least about: A·1 = M/h².
  const Vertices b = (cloth.masses / 0.01).asDiagonal() * Vertices::Ones(cloth.vertex_count(), 3);
  Vertices x(cloth.vertex_count(), 3);
  factor.solve(b, x);
  EXPECT_LT((x - Vertices::Ones(cloth.vertex_count(), 3)).cwiseAbs().maxCoeff(), 1e-3);
}

}  // namespace
}  // namespace drape::test
