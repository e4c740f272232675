#pragma once

#include <vector>

#include "sim/linear/sparse_cholesky.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// Orders the rows of a matrix by nested dissection (George 1973): halves the cloth across its longer side, numbers the
/// separating vertices last, and recurses into both halves. On a grid of n vertices the factor then has O(n log n)
/// entries and takes O(n^1.5) operations, which is optimal (Lipton, Rose and Tarjan 1979).
/// @param pattern of the matrix
/// @param places  positions of the rows, n×3 [m]. Coupled rows should be near each other; otherwise the order is valid
///                but
///                has more fill
/// @returns the rows in order, the same for the same arguments
std::vector<int> dissect(const LowerPattern& pattern, const Vertices& places);

}  // namespace drape
