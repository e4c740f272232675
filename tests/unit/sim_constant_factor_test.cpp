#include <gtest/gtest.h>

#include <vector>

#include "sim/linear/constant_factor.hpp"
#include "tests/support/matrices.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

/// Returns ‖A x − b‖/‖b‖ over the free vertices.
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

    ConstantFactor doubles(system, system.step, Precision::double_precision);
    EXPECT_FALSE(doubles.single_precision());
    doubles.solve(b, x);
    EXPECT_LT(residual(system, x, b), 1e-12);
    for (const int pin : cloth.pins) EXPECT_EQ(x.row(pin).norm(), 0);

    // The condition of A is a few hundred here, and single precision has an error of 6e-8.
    ConstantFactor singles(system, system.step, Precision::single_precision);
    EXPECT_TRUE(singles.single_precision());
    singles.solve(b, x);
    EXPECT_LT(residual(system, x, b), 1e-5);
    EXPECT_GT(residual(system, x, b), 1e-12) << "is this single precision?";
    for (const int pin : cloth.pins) EXPECT_EQ(x.row(pin).norm(), 0);
    EXPECT_TRUE(ConstantFactor(system, system.step, Precision::automatic).single_precision());
  }
}

// Beyond 20 000 free vertices another factor is used.
TEST(ConstantFactor, SolvesForAnySizeOfCloth) {
  for (const int cells : {139, 142}) {
    const Cloth cloth = cloth_of(make_grid(cells, cells), 1, 180, {0, 7});
    const System system(cloth, 0.02);
    const Vertices b = random_vertices(cloth.vertex_count(), 1);
    Vertices x = Vertices::Constant(cloth.vertex_count(), 3, 99);
    ConstantFactor(system, system.step, Precision::double_precision).solve(b, x);
    EXPECT_LT(residual(system, x, b), 1e-11) << cells;
    ConstantFactor single(system, system.step, Precision::automatic);
    EXPECT_TRUE(single.single_precision());
    Vertices rounded = x;
    single.solve(b, rounded);
    EXPECT_LT((rounded - x).norm(), 1e-3 * x.norm()) << cells;
    for (const int pin : cloth.pins) EXPECT_EQ(rounded.row(pin).norm(), 0);
  }
}

TEST(ConstantFactor, SolvesForNumbersOfAnySize) {
  const Cloth cloth = cloth_of(make_grid(8, 8), 1, 180, {0, 8});
  const System system(cloth, 0.02);
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    ConstantFactor factor(system, system.step, precision);
    for (const double scale : {1e-25, 1e-12, 1e12, 1e25}) {
      const Vertices b = scale * random_vertices(cloth.vertex_count(), 1);
      Vertices x(cloth.vertex_count(), 3);
      factor.solve(b, x);
      EXPECT_LT(residual(system, x, b), 1e-5);
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
    ConstantFactor factor(system, system.step, precision);
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
    ConstantFactor factor(system, system.step, precision);
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
    ConstantFactor factor(system, system.step, precision);
    const Vertices b = random_vertices(16, 1);
    Vertices x(16, 3);
    factor.solve(b, x);
    EXPECT_LT(residual(system, x, b), 1e-6);
  }
}

/// Makes n vertices in a row, pinned at one end: the condition of A grows with n².
Cloth long_chain(int n, double stiffness) {
  Cloth cloth;
  cloth.positions = cloth.velocities = Vertices::Zero(n, 3);
  cloth.masses.setConstant(n, 1.0 / n);
  for (int i = 0; i + 1 < n; ++i) {
    cloth.springs.push_back({.i = i, .j = i + 1, .rest_length = 0, .stiffness = stiffness});
  }
  cloth.pins = {0};
  return cloth;
}

// A has no positive off-diagonal entries, so its factor loses far fewer digits than its condition suggests. Single
// precision loses three of them only with both very many vertices in a row and a large k h²/m.
TEST(ConstantFactor, DoesNotChooseSinglePrecisionWhereItIsTooCoarse) {
  const Cloth cloth = long_chain(tries(300'000), 1e15);
  const System system(cloth, 0.1);
  const Vertices b = random_vertices(cloth.vertex_count(), 1);
  Vertices chosen(cloth.vertex_count(), 3), exact = chosen;
  ConstantFactor(system, system.step, Precision::double_precision).solve(b, exact);
  ConstantFactor(system, system.step, Precision::automatic).solve(b, chosen);
  EXPECT_LT((chosen - exact).norm(), 2e-3 * exact.norm());
}

TEST(ConstantFactor, FallsBackToDoublePrecisionBeyondTheRangeOfSingle) {
  const Cloth cloth = cloth_of(make_grid(10, 10), 1, 1e80, {0});
  const System system(cloth, 0.1);
  ConstantFactor factor(system, system.step, Precision::automatic);
  EXPECT_FALSE(factor.single_precision());
  Vertices x(cloth.vertex_count(), 3);
  factor.solve(random_vertices(cloth.vertex_count(), 1), x);
  EXPECT_TRUE(x.allFinite());
}

TEST(ConstantFactor, KeepsThreeDigitsHoweverStiffTheCloth) {
  for (const double stiffness : {1e3, 1e6, 1e9}) {
    const Cloth cloth = cloth_of(irregular_mesh(20), 1, stiffness, {0});
    const System system(cloth, 0.1);
    const Vertices b = random_vertices(cloth.vertex_count(), 1);
    Vertices chosen(cloth.vertex_count(), 3), exact = chosen;
    ConstantFactor(system, system.step, Precision::automatic).solve(b, chosen);
    ConstantFactor(system, system.step, Precision::double_precision).solve(b, exact);
    EXPECT_LT((chosen - exact).norm(), 1e-3 * exact.norm()) << stiffness << " N/m";
  }
}

}  // namespace
}  // namespace drape::test
