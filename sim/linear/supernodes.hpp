#pragma once

#include <vector>

#include "sim/linear/sparse_cholesky.hpp"

namespace drape {

/// Where the entries of a Cholesky factor are: neighbouring columns that share the rows below them are one supernode.
/// Those with few columns are merged with the next where that stores few zeros.
struct Supernodes {
  std::vector<int> order;           ///< row r of L is row order[r] of A
  std::vector<int> first;           ///< column of each supernode, and n
  std::vector<std::size_t> starts;  ///< of each supernode's rows, and their number
  std::vector<int> rows;            ///< below each supernode, ascending
  double operations = 0;            ///< multiplications and additions that L takes without the stored zeros

  [[nodiscard]] int count() const { return static_cast<int>(first.size()) - 1; }
  [[nodiscard]] int width(int s) const { return first[std::size_t(s) + 1] - first[std::size_t(s)]; }
  [[nodiscard]] int below(int s) const { return static_cast<int>(starts[std::size_t(s) + 1] - starts[std::size_t(s)]); }
};

/// Those of the factor of a matrix, by CHOLMOD's analysis. A supernode comes after all that are below it in the
/// elimination tree, children one after another (a postorder).
/// @param order of the rows; CHOLMOD renumbers it along the tree. Empty: CHOLMOD chooses one
/// @throws UsageError if the factor has more than 2³¹ entries
Supernodes find_supernodes(const LowerPattern& pattern, const std::vector<int>& order);

}  // namespace drape
