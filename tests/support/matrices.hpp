#pragma once

#include <Eigen/SparseCore>

#include "sim/linear/sparse_cholesky.hpp"
#include "sim/system.hpp"

namespace drape::test {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Assembles A = M/h² + Σ k (eᵢ − eⱼ)(eᵢ − eⱼ)ᵀ over all n vertices, with identity rows and columns for pins.
SparseMatrix constant_matrix(const System& system);

/// Assembles H = M/h² + Σ K over all 3n coordinates (x, y, z of vertex 0 first), identity for those of pins:
///   K = k x̂x̂ᵀ + k max(0, 1 − L/‖d‖)(I − x̂x̂ᵀ).
SparseMatrix newton_matrix(const System& system, const Vertices& x);

}  // namespace drape::test
