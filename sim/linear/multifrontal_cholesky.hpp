#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "sim/kernels/kernels.hpp"
#include "sim/linear/dense_front.hpp"
#include "sim/linear/supernodes.hpp"

namespace drape {

/// The Cholesky factorisation A = Pᵀ L Lᵀ P of a sparse symmetric positive-definite matrix by dense fronts (Duff and
/// Reid 1983; Liu 1992), with the same bits on every machine. The sparsity is analysed once; the values may change.
///
/// The front of a supernode is the dense matrix of its columns and the rows below: the entries of A plus the update
/// matrices of its children in the elimination tree. Eliminating its columns gives those of L, which are written at
/// once as panels for the substitution. The remaining update matrix for its parent goes onto a stack.
class MultifrontalCholesky {
 public:
  /// Called every few milliseconds of work. An exception from it ends the factorisation without a factor.
  using Pause = std::function<void()>;

  /// Analyses the pattern.
  /// @param order        of the rows, with little fill, see dissect(). CHOLMOD's own order is tried if it is empty or
  ///                     poor
  /// @param caller_bytes kept by the caller for each entry of the factor
  /// @throws UsageError if the factor cannot fit into memory, or takes far longer than that of a surface
  explicit MultifrontalCholesky(const LowerPattern& pattern, const std::vector<int>& order = {},
                                double caller_bytes = 0);

  /// Computes the factor of the matrix whose lower triangle has these values, in the order of the pattern.
  /// @return false if it is not positive definite to working precision; solve() is then not allowed
  [[nodiscard]] bool factorize(const double* values, const Pause& pause = {});

  /// Solves A x = b for one right-hand side of n numbers; x and b may be the same. Allocates nothing.
  void solve(const double* b, double* x);

  /// Returns the permutation: row r of L is row permutation()[r] of A.
  [[nodiscard]] const std::vector<int>& permutation() const { return tree_.order; }
  /// Returns the operations of a factorisation, multiplications and additions: Σ c² over columns of c entries.
  [[nodiscard]] double operations() const { return operations_; }
  /// Returns the numbers stored for L, including zeros within supernodes.
  [[nodiscard]] std::size_t entries() const { return entries_; }

  /// The factor, for a solve or to be moved out.
  struct Panels {
    std::vector<Panel> panels;
    std::vector<int> rows;
    std::vector<double> values;
  };
  [[nodiscard]] PackedTriangle<double> triangle() const {
    return {factor_.panels.data(), static_cast<int>(factor_.panels.size()), factor_.rows.data(), factor_.values.data()};
  }
  [[nodiscard]] Panels take() && { return std::move(factor_); }

 private:
  /// Positions of A's entries in the order of L: column c has the entries e with starts[c] ≤ e < starts[c+1].
  struct Entries {
    std::vector<int> starts, rows, places;  // rows in L, and indices of the values
  };
  struct Sizes {
    std::size_t largest_front = 0, stack = 0;
    int most_below = 0;
  };

  /// Counts children, operations and entries, and lays the panels out.
  Sizes lay_out();
  void add_panels(int supernode);
  [[nodiscard]] int parent_of(int supernode, const std::vector<int>& supernode_of_row) const;
  void map_entries(const LowerPattern& pattern);
  void assemble(int supernode, const double* values);
  void add_child(int child, const double* left);

  Supernodes tree_;
  std::vector<int> children_;  // number of children of each supernode
  Entries matrix_;
  Panels factor_;
  std::size_t entries_ = 0;
  double operations_ = 0;

  std::optional<DenseFront> front_;
  std::vector<double> stack_;     // update matrices for later fronts
  std::vector<int> waiting_;      // their supernodes
  std::vector<int> place_;        // rows of L to rows of the current front
  std::vector<int> child_rows_;   // rows of a child in the current front
  std::vector<double> solution_;  // see Kernels::solve_double
};

}  // namespace drape
