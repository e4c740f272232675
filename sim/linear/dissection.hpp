#pragma once

#include <vector>

#include "sim/linear/sparse_cholesky.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// An order of the rows of a matrix by nested dissection (George 1973): halves the cloth across its longer side,
/// numbers the vertices that keep the halves apart last, and goes on in each half. On a grid of n vertices the factor
/// then has O(n log n) entries and takes O(n^1.5) operations, which is as few as can be (Lipton, Rose and Tarjan 1979).
/// @param pattern of the matrix
/// @param places  of the rows, n×3 [m]: rows that are coupled should be near each other. Where they are not, or all are
///                in one place, the order is still one, with more fill
/// @returns the rows in their order, the same for the same arguments
std::vector<int> dissect(const LowerPattern& pattern, const Vertices& places);

}  // namespace drape
