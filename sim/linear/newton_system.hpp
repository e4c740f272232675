#pragma once

#include <vector>

#include "sim/linear/free_vertices.hpp"
#include "sim/linear/sparse_cholesky.hpp"
#include "sim/system.hpp"

namespace drape {

/// Newton's equations H p = ∇g over the free vertices, H = M/h² + Σ Kₛ with one symmetric 3×3 block per spring:
///   K = k x̂x̂ᵀ + k (1 − L/‖d‖)(I − x̂x̂ᵀ)   where it is stretched, d = xᵢ − xⱼ, x̂ = d/‖d‖,
///   K = k x̂x̂ᵀ                              where it is compressed, which keeps H positive definite.
/// The sparsity is analysed once, on the n×n graph of vertices; every assembly writes the values in place.
class NewtonSystem {
 public:
  explicit NewtonSystem(const System& system);

  /// Computes H at x and factors it.
  /// @throws std::domain_error if H is not positive definite to working precision
  void factorize(const Vertices& x);

  /// direction = H⁻¹ gradient, n×3 and zero on pins. [N] → [m]
  void solve(const Vertices& gradient, Vertices& direction);

 private:
  /// Where a spring's block goes: the rows of its ends in H/3 (−1 for a pin), and the place of the off-diagonal block
  /// among those of the smaller row's column.
  struct Place {
    int low, high, rank;
  };

  void add_diagonal(int row, const Eigen::Matrix3d& block);
  void add_below(int column, int rank, const Eigen::Matrix3d& block);

  const System& system_;
  std::vector<int> vertices_;       // of each block row
  std::vector<Place> places_;       // of each spring
  std::vector<int> column_starts_;  // 3 per block row: where each scalar column begins in values_
  std::vector<double> values_;      // lower triangle of H
  std::vector<double> inertia_;     // m/h² of each block row
  std::vector<double> right_hand_side_;
  std::vector<SparseCholesky> factor_;  // one, absent where everything is pinned
};

}  // namespace drape
