// A bent sheet's equilibrium on every kind of mesh: the minimum in which the mesh may ripple, not the energy of a given
// shape.

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

/// Bending for small deflections: K u = M a, with u the deflection of the free vertices.
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

/// Returns the sag of the tip of a heavy strip of 0.2 m, relative to Euler and Bernoulli's ρgL⁴/8D.
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

/// Returns the first frequency of a clamped square of n×n cells, relative to the plate's 35.985 √(D/ρ)/a².
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

/// Returns the springs' forces for small displacements in a sheet's plane, when the sheet is heavy along y.
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
      const Eigen::Index number = numbers[static_cast<std::size_t>(vertex)];
      return number < 0 ? Eigen::RowVector2d::Zero() : Eigen::RowVector2d(moved[2 * number], moved[2 * number + 1]);
    };
    const Eigen::RowVector2d along = (cloth.rest.row(spring.j) - cloth.rest.row(spring.i)).head<2>().normalized();
    forces[s] = spring.stiffness * (at(spring.j) - at(spring.i)).dot(along);
  }
  return forces;
}

/// Returns the weight w L³/D, w per area, at which a strip standing on its narrow side buckles: the least λ for which
/// the springs' lateral forces, λ G u, exceed its bending forces, K u. G has eigenvalues of both signs.
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

// Cells of a quarter of the size.
TEST_P(OnEveryMesh, AHeavyStripIsMetToTheSecondOrder) {
  const double coarse = std::abs(tip_ratio(GetParam(), 16) - 1), fine = std::abs(tip_ratio(GetParam(), 64) - 1);
  EXPECT_GT(std::log2(coarse / fine) / 2, 1.5) << coarse << ", " << fine;
}

TEST_P(OnEveryMesh, AClampedSquareRingsAsAPlate) {
  const bool wide = GetParam() == Division::wide_alternating || GetParam() == Division::wide_crossed;
  EXPECT_NEAR(frequency_ratio(GetParam(), wide ? 120 : 30), 1, 0.01);  // 30 cells each way, or 120 by 30
}

// Prandtl's lateral buckling of a strip under its own weight: 12.85 √(B C)/L³ with the stiffness B = D b of sideways
// bending and C = 2 D b of twisting, for each width b.
TEST_P(OnEveryMesh, ANarrowStripBucklesToTheSide) {
  EXPECT_NEAR(buckling_load(GetParam(), 128, 4), 12.85 * std::numbers::sqrt2, 0.03 * 18.2);
}

/// Makes a strip of unit length whose rest shape is a quarter of a circle from its clamp on.
Cloth quarter_circle(Division division, int cells) {
  constexpr double radius = 2 / std::numbers::pi;
  test::Sheet sheet = test::clamped_strip(division, cells, cells / 4, 1);
  for (Eigen::Index i = 0; i < sheet.mesh.positions.rows(); ++i) {
    const double angle = std::max(0.0, sheet.mesh.positions(i, 0)) / radius;
    sheet.mesh.positions(i, 0) = radius * std::sin(angle) + std::min(0.0, sheet.mesh.positions(i, 0));
    sheet.mesh.positions(i, 2) = radius * (1 - std::cos(angle));
  }
  return test::cloth_of(sheet, 1);
}

/// Returns the sag of the tip of a quarter circle of unit length under a unit weight per area, small against D = 1.
double curved_tip(const Cloth& cloth) {
  const SmallBending unknowns(cloth, 1);
  const auto count = unknowns.masses.size();
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](const Spring& pair, const Eigen::Matrix3d& block) {
    const std::array ends{unknowns.numbers[static_cast<std::size_t>(pair.i)],
                          unknowns.numbers[static_cast<std::size_t>(pair.j)]};
    for (std::size_t a = 0; a < 2; ++a) {
      for (std::size_t b = 0; b < 2; ++b) {
        if (ends[a] < 0 || ends[b] < 0) continue;
        for (int k = 0; k < 9; ++k) {
          entries.emplace_back(3 * ends[a] + k / 3, 3 * ends[b] + k % 3, (a == b ? 1 : -1) * block(k / 3, k % 3));
        }
      }
    }
  };
  for (const Spring& s : cloth.springs) {
    const Eigen::Vector3d along = (cloth.rest.row(s.j) - cloth.rest.row(s.i)).normalized().transpose();
    add(s, s.stiffness * along * along.transpose());
  }
  const BendingEnergy energy(curvature_elements(cloth, 1), cloth.vertex_count());
  const auto hessian = energy.make_hessian();
  hessian->linearise(cloth.rest, 0, 1);
  HessianBlocks blocks;
  hessian->add_blocks(blocks);
  for (std::size_t p = 0; p < blocks.pairs.size(); ++p) add(energy.pairs()[p], blocks.pairs[p]);
  Eigen::SparseMatrix<double> matrix(3 * count, 3 * count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(3 * count);
  for (Eigen::Index i = 0; i < count; ++i) weight[3 * i + 2] = unknowns.masses[i];
  const Eigen::VectorXd moved = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(weight);
  double sum = 0;
  int tips = 0;
  for (int v = 0; v < cloth.vertex_count(); ++v) {
    if (cloth.rest(v, 2) < cloth.rest.col(2).maxCoeff() - 1e-9) continue;
    sum += moved[3 * unknowns.numbers[static_cast<std::size_t>(v)] + 2];
    ++tips;
  }
  return sum / tips;
}

// By Castigliano: δ = ∫ M m/D ds, with M the moment of the weight beyond, m that of a unit load at the tip.
TEST_P(OnEveryMesh, ACurvedStripSinksAsACurvedBeam) {
  constexpr int parts = 2000;
  const double radius = 2 / std::numbers::pi, end = std::numbers::pi / 2;
  double expected = 0;
  for (int k = 0; k < parts; ++k) {
    const double angle = end * (k + 0.5) / parts;
    const double moment = radius * radius * (std::cos(angle) - (end - angle) * std::sin(angle));
    expected += moment * radius * (1 - std::sin(angle)) * radius * end / parts;
  }
  Cloth cloth = quarter_circle(GetParam(), 24);
  stiffen_by_area(1e5, cloth);
  EXPECT_NEAR(curved_tip(cloth) / expected, 1, 0.02);
}

}  // namespace
}  // namespace drape::bending_equilibrium_test
