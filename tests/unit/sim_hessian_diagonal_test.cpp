#include <gtest/gtest.h>

#include <Eigen/LU>

#include "sim/linear/newton_solver.hpp"
#include "tests/support/matrices.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

using Block = Eigen::Matrix3d;

/// Returns D by its definition: m/h² I + 2 Σ K = 2 H − m/h² I in the diagonal blocks of H.
Block block_of(const SparseMatrix& hessian, const System& system, int vertex) {
  const Eigen::Index first = 3 * Eigen::Index{vertex};
  return 2 * Block(hessian.block(first, first, 3, 3)) - system.inertia(system.step)[vertex] * Block::Identity();
}

TEST(HessianDiagonal, SolvesForTheBlocksOfTheHessian) {
  for (const Mesh& mesh : {make_grid(9, 7), irregular_mesh(8), three_sheets(5)}) {
    const Cloth cloth = cloth_of(mesh, 1, 180, {0, 7});
    const System system(cloth, 0.02);
    const StepObjective objective(system, system.step);
    const Vertices x = cloth.positions + 0.1 * random_vertices(cloth.vertex_count(), 1);
    Vertices b = random_vertices(cloth.vertex_count(), 2);
    for (const int pin : cloth.pins) b.row(pin).setZero();
    SpringNetwork::Blocks springs;
    objective.springs().compute_blocks(x, 0, springs);
    HessianDiagonal diagonal(system, objective);
    diagonal.linearise(springs);
    const Vertices before = random_vertices(cloth.vertex_count(), 3);
    Vertices after = before;
    diagonal.add_solution(b, after);

    const SparseMatrix hessian = newton_matrix(system, x);
    for (int vertex = 0, pin = 0; vertex < cloth.vertex_count(); ++vertex) {
      const Eigen::Vector3d added = (after - before).row(vertex).transpose(), force = b.row(vertex).transpose();
      if (pin < static_cast<int>(cloth.pins.size()) && cloth.pins[static_cast<std::size_t>(pin)] == vertex) {
        EXPECT_EQ(added.norm(), 0);
        ++pin;
      } else {
        EXPECT_LT((block_of(hessian, system, vertex) * added - force).norm(), 1e-9 * force.norm()) << vertex;
      }
    }
  }
}

// D never contains negative parts across compressed springs, whatever share of them the Hessian has; parts along
// springs are complete.
TEST(HessianDiagonal, IsTheSameWithAnyShareOfTheNegativeEigenvalues) {
  for (const Mesh& mesh : {make_grid(9, 7), irregular_mesh(8), three_sheets(5)}) {
    const Cloth cloth = cloth_of(mesh, 1, 180, {0, 7});
    const System system(cloth, 0.02);
    const StepObjective objective(system, system.step);
    const Vertices x = 0.6 * cloth.positions + 0.05 * random_vertices(cloth.vertex_count(), 1);
    const Vertices b = random_vertices(cloth.vertex_count(), 2);
    HessianDiagonal diagonal(system, objective);
    const auto solution = [&](double concavity) {
      SpringNetwork::Blocks springs;
      objective.springs().compute_blocks(x, concavity, springs);
      diagonal.linearise(springs);
      Vertices solved = Vertices::Zero(cloth.vertex_count(), 3);
      diagonal.add_solution(b, solved);
      return solved;
    };
    const Vertices without = solution(0);
    for (const double concavity : {0.25, 1.0}) {
      EXPECT_LT((solution(concavity) - without).norm(), 1e-9 * without.norm()) << concavity;
    }
  }
}

// Conjugate gradients with A⁻¹ + D⁻¹ rely on D⁻¹ ⪯ H⁻¹, that is bᵀD⁻¹b ≤ bᵀp with H p = b.
TEST(HessianDiagonal, IsNowhereBelowTheHessian) {
  const Cloth cloth = cloth_of(irregular_mesh(10), 1, 180, {0});
  const System system(cloth, 0.02);
  const StepObjective objective(system, system.step);
  HessianDiagonal diagonal(system, objective);
  for (const int seed : {1, 2, 3}) {
    const Vertices x = cloth.positions + 0.05 * random_vertices(cloth.vertex_count(), seed);
    SpringNetwork::Blocks springs;
    objective.springs().compute_blocks(x, 0, springs);
    diagonal.linearise(springs);
    const SparseMatrix hessian = newton_matrix(system, x);
    Vertices p = random_vertices(cloth.vertex_count(), seed + 10);
    p.row(0).setZero();
    const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> rows = p;
    const Eigen::VectorXd product = hessian * Eigen::Map<const Eigen::VectorXd>(rows.data(), rows.size());
    const Vertices b = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(
        product.data(), cloth.vertex_count(), 3);
    Vertices free = b, solution = Vertices::Zero(cloth.vertex_count(), 3);
    free.row(0).setZero();
    diagonal.add_solution(free, solution);
    EXPECT_LE(free.cwiseProduct(solution).sum(), b.cwiseProduct(p).sum());
  }
}

/// Counts the iterations for a cloth that falls flat, with a different force on every vertex.
int iterations(const Mesh& mesh) {
  int looks = 0;
  const Cloth cloth = cloth_of(mesh, 1, 180, {0});
  System system(cloth, 0.02);
  system.stop = Stop([&looks] { return ++looks < 0; });
  const StepObjective objective(system, system.step);
  ConjugateGradients solver(system, objective);
  Vertices b = random_vertices(cloth.vertex_count(), 4), direction(cloth.vertex_count(), 3);
  b.row(0).setZero();
  looks = 0;
  solver.solve(cloth.positions, b, 0, direction);
  return looks;
}

// Only inertia holds a flat cloth out of plane, which A hardly contains: finer cloth is farther from A, but D includes
// inertia.
TEST(HessianDiagonal, LetsFineClothTakeFewerIterationsThanCoarse) {
  EXPECT_LT(2 * iterations(make_grid(32, 31)), iterations(make_grid(31, 30)));
}

}  // namespace
}  // namespace drape::test
