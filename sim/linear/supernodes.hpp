#pragma once

#include <vector>

#include "sim/linear/sparse_cholesky.hpp"

namespace drape {

/// Structure of a Cholesky factor: neighbouring columns that share the rows below form a supernode. Narrow ones are
/// merged with the next if that stores few zeros.
struct Supernodes {
  std::vector<int> order;           ///< row r of L is row order[r] of A
  std::vector<int> first;           ///< first column of each supernode, then n
  std::vector<std::size_t> starts;  ///< start of each supernode's rows, then their number
  std::vector<int> rows;            ///< rows below each supernode, ascending
  double operations = 0;            ///< multiplications and additions for L without the stored zeros

  [[nodiscard]] int count() const { return static_cast<int>(first.size()) - 1; }
  [[nodiscard]] int width(int s) const { return first[std::size_t(s) + 1] - first[std::size_t(s)]; }
  [[nodiscard]] int below(int s) const { return static_cast<int>(starts[std::size_t(s) + 1] - starts[std::size_t(s)]); }
};

/// Returns the supernodes of a matrix's factor, by CHOLMOD's analysis, in postorder of the elimination tree: children
/// before their parent and one after another.
/// @param order of the rows; CHOLMOD renumbers it along the tree. Empty: CHOLMOD chooses one
/// @throws UsageError if the factor has more than 2³¹ entries
Supernodes find_supernodes(const LowerPattern& pattern, const std::vector<int>& order);

}  // namespace drape
