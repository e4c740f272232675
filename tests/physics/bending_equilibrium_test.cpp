// A bent sheet's equilibrium on every kind of mesh: what is left when the mesh may ripple, not what a given shape
// holds.

#include <gtest/gtest.h>

#include <Eigen/Sparse>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/bending/bending_energy.hpp"
#include "tests/support/sheets_to_bend.hpp"

namespace drape::bending_equilibrium_test {
namespace {

using test::Division;

/// Bending for small deflections: K u = M a, u across the sheet, of the vertices that are not pinned.
struct SmallBending {
  std::vector<int> numbers;  // of the unknowns, −1 for pinned vertices
  Eigen::VectorXd masses;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> stiffness;

  SmallBending(const Cloth& cloth, double rigidity) : numbers(static_cast<std::size_t>(cloth.vertex_count())) {
    for (const int pin : cloth.pins) numbers[static_cast<std::size_t>(pin)] = -1;
    int count = 0;
    for (int& number : numbers) number = number < 0 ? -1 : count++;
    masses.resize(count);
    for (std::size_t v = 0; v < numbers.size(); ++v) {
      if (numbers[v] >= 0) masses[numbers[v]] = cloth.masses[static_cast<Eigen::Index>(v)];
    }
    std::vector<Eigen::Triplet<double>> entries;
    const BendingEnergy energy(curvature_elements(cloth, rigidity), cloth.vertex_count());
    for (const Spring& pair : energy.pairs()) {
      const int i = numbers[static_cast<std::size_t>(pair.i)], j = numbers[static_cast<std::size_t>(pair.j)];
      if (i >= 0) entries.emplace_back(i, i, pair.stiffness);
      if (j >= 0) entries.emplace_back(j, j, pair.stiffness);
      if (i < 0 || j < 0) continue;
      entries.emplace_back(i, j, -pair.stiffness);
      entries.emplace_back(j, i, -pair.stiffness);
    }
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    stiffness.compute(matrix);
    EXPECT_EQ(stiffness.info(), Eigen::Success);
    EXPECT_GT(stiffness.vectorD().minCoeff(), 0) << "a bend that costs nothing";
  }
};

/// How far the tip of a heavy strip of 0.2 m sinks, over Euler and Bernoulli's ρgL⁴/8D.
double tip_ratio(Division division, int cells) {
  constexpr double length = 0.2, load = 2, rigidity = 0.3;
  const test::Sheet sheet = test::clamped_strip(division, cells, cells / 4, length);
  const Cloth cloth = test::cloth_of(sheet, load);
  const SmallBending bending(cloth, rigidity);
  const Eigen::VectorXd sunk = bending.stiffness.solve(bending.masses);
  double sum = 0;
  int count = 0;
  for (std::size_t v = 0; v < bending.numbers.size(); ++v) {
    if (cloth.rest(static_cast<Eigen::Index>(v), 0) < length - 1e-9) continue;
    sum += sunk[bending.numbers[v]];
    ++count;
  }
  return sum / count * 8 * rigidity / (load * std::pow(length, 4));
}

/// The first frequency of a clamped square of n×n cells over the plate's, 35.985 √(D/ρ)/a².
double frequency_ratio(Division division, int n) {
  constexpr double density = 0.2, rigidity = 0.3;
  const SmallBending bending(test::cloth_of(test::clamped_square(division, n), density), rigidity);
  Eigen::VectorXd mode = Eigen::VectorXd::Ones(bending.masses.size());
  double square = 0;
  for (int i = 0; i < 30; ++i) {
    const Eigen::VectorXd next = bending.stiffness.solve(bending.masses.cwiseProduct(mode));
    const Eigen::VectorXd weighted = bending.masses.cwiseProduct(next);
    square = weighted.dot(mode) / weighted.dot(next);
    mode = next.normalized();
  }
  return std::sqrt(square * density / rigidity) / 35.985;
}

/// Springs along a sheet for small displacements in its plane: the force on each when the sheet is heavy along y.
Eigen::VectorXd forces_of_weight(const Cloth& cloth, const std::vector<int>& numbers, const Eigen::VectorXd& masses) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Spring& spring : cloth.springs) {
    const Eigen::RowVector2d along = (cloth.rest.row(spring.j) - cloth.rest.row(spring.i)).head<2>().normalized();
    const std::array ends{numbers[static_cast<std::size_t>(spring.i)], numbers[static_cast<std::size_t>(spring.j)]};
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        const int i = ends[static_cast<std::size_t>(a / 2)], j = ends[static_cast<std::size_t>(b / 2)];
        const double sign = a / 2 == b / 2 ? 1 : -1;
        if (i >= 0 && j >= 0)
          entries.emplace_back(2 * i + a % 2, 2 * j + b % 2, sign * spring.stiffness * along[a % 2] * along[b % 2]);
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(2 * masses.size(), 2 * masses.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(2 * masses.size());
  for (Eigen::Index i = 0; i < masses.size(); ++i) weight[2 * i + 1] = -masses[i];
  const Eigen::VectorXd moved = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(weight);
  Eigen::VectorXd forces(static_cast<Eigen::Index>(cloth.springs.size()));
  for (Eigen::Index s = 0; s < forces.size(); ++s) {
    const Spring& spring = cloth.springs[static_cast<std::size_t>(s)];
    const auto at = [&](int vertex) -> Eigen::RowVector2d {
      const int number = numbers[static_cast<std::size_t>(vertex)];
      return number < 0 ? Eigen::RowVector2d::Zero() : Eigen::RowVector2d(moved[2 * number], moved[2 * number + 1]);
    };
    const Eigen::RowVector2d along = (cloth.rest.row(spring.j) - cloth.rest.row(spring.i)).head<2>().normalized();
    forces[s] = spring.stiffness * (at(spring.j) - at(spring.i)).dot(along);
  }
  return forces;
}

/// The weight w L³/D, w that of an area, at which a strip that stands on its narrow side buckles: the least λ for which
/// the springs' forces across it, λ G u, outdo its bending, K u. G has eigenvalues of both signs.
double buckling_load(Division division, int cells, int across) {
  constexpr double length = 1, rigidity = 1;
  Cloth cloth = test::cloth_of(test::clamped_strip(division, cells, across, length), 1);
  stiffen_by_area(1, cloth);
  const SmallBending bending(cloth, rigidity);
  const Eigen::VectorXd forces = forces_of_weight(cloth, bending.numbers, bending.masses);
  const auto push = [&](const Eigen::VectorXd& u) {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(u.size());
    for (Eigen::Index s = 0; s < forces.size(); ++s) {
      const Spring& spring = cloth.springs[static_cast<std::size_t>(s)];
      const int i = bending.numbers[static_cast<std::size_t>(spring.i)];
      const int j = bending.numbers[static_cast<std::size_t>(spring.j)];
      const double pull = forces[s] / spring.rest_length * ((i < 0 ? 0 : u[i]) - (j < 0 ? 0 : u[j]));
      if (i >= 0) result[i] += pull;
      if (j >= 0) result[j] -= pull;
    }
    return result;
  };
  Eigen::VectorXd mode = Eigen::VectorXd::LinSpaced(bending.masses.size(), 1, 2);
  double square = 0;
  for (int i = 0; i < 60; ++i) {
    const Eigen::VectorXd once = bending.stiffness.solve(push(mode)), twice = bending.stiffness.solve(push(once));
    square = twice.norm() / mode.norm();
    mode = twice.normalized();
  }
  return 1 / std::sqrt(square);
}

class OnEveryMesh : public testing::TestWithParam<Division> {};
INSTANTIATE_TEST_SUITE_P(, OnEveryMesh, testing::ValuesIn(test::all_divisions()),
                         [](const auto& tested) { return test::name_of(tested.param); });

TEST_P(OnEveryMesh, AHeavyStripSinksAsABeam) {
  EXPECT_NEAR(tip_ratio(GetParam(), 20), 1, 4e-3);
  EXPECT_NEAR(tip_ratio(GetParam(), 40), 1, 1e-3);
}

// By regression over three meshes, each of half the cells' size.
TEST_P(OnEveryMesh, AHeavyStripIsMetToTheSecondOrder) {
  const double coarse = std::abs(tip_ratio(GetParam(), 16) - 1), fine = std::abs(tip_ratio(GetParam(), 64) - 1);
  EXPECT_GT(std::log2(coarse / fine) / 2, 1.5) << coarse << ", " << fine;
}

TEST_P(OnEveryMesh, AClampedSquareRingsAsAPlate) {
  const bool wide = GetParam() == Division::wide_alternating || GetParam() == Division::wide_crossed;
  if (wide) GTEST_SKIP() << "seven cells across are no plate";
  EXPECT_NEAR(frequency_ratio(GetParam(), 30), 1, 0.01);
}

// Prandtl's lateral buckling of a strip under its own weight: 12.85 √(B C)/L³ with the stiffness B = D b against
// bending to the side and C = 2 D b against twisting, for each width b.
TEST_P(OnEveryMesh, ANarrowStripBucklesToTheSide) {
  if (GetParam() == Division::delaunay) GTEST_SKIP() << "four uneven cells across are not the same width everywhere";
  EXPECT_NEAR(buckling_load(GetParam(), 64, 4), 12.85 * std::numbers::sqrt2, 0.03 * 18.2);
}

}  // namespace
}  // namespace drape::bending_equilibrium_test
