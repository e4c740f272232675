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
/// The front of a supernode is the dense matrix of its columns and the rows below: what A has there, and what its
/// children in the elimination tree have left for it. Eliminating its columns gives those of L, which are written out
/// as panels for the substitution at once, and what is left for its parent, which goes onto a stack.
class MultifrontalCholesky {
 public:
  /// Called every few milliseconds of work. What it throws ends the factorisation, after which there is none.
  using Pause = std::function<void()>;

  /// Analyses the pattern.
  /// @param order        of its rows that leaves little fill, see dissect(). CHOLMOD's own is tried where it is empty,
  ///                     and where the order turns out to be no good one
  /// @param caller_bytes that the caller will keep for each entry of the factor
  /// @throws UsageError if the factor cannot fit into memory, or takes far longer than one of a surface
  explicit MultifrontalCholesky(const LowerPattern& pattern, const std::vector<int>& order = {},
                                double caller_bytes = 0);

  /// Computes the factor of the matrix whose lower triangle has these values, in the order of the pattern.
  /// @return false if it is not positive definite to working precision; solve() is then not allowed
  [[nodiscard]] bool factorize(const double* values, const Pause& pause = {});

  /// Solves A x = b for one right-hand side of n numbers; x and b may be the same. Allocates nothing.
  void solve(const double* b, double* x);

  /// Row r of L belongs to row permutation()[r] of A.
  [[nodiscard]] const std::vector<int>& permutation() const { return tree_.order; }
  /// Multiplications and additions of a factorisation: Σ c² over columns of c entries.
  [[nodiscard]] double operations() const { return operations_; }
  /// Numbers stored for L, the zeros within supernodes included.
  [[nodiscard]] std::size_t entries() const { return entries_; }

  /// The factor itself, to be solved with or to be moved away.
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
  /// Where the entries of A's columns are, as L has them: entry e of L's column c, starts[c] ≤ e < starts[c+1].
  struct Entries {
    std::vector<int> starts, rows, places;  // their rows in L, and where they are among the values
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
  std::vector<int> children_;  // of each supernode, how many
  Entries matrix_;
  Panels factor_;
  std::size_t entries_ = 0;
  double operations_ = 0;

  std::optional<DenseFront> front_;
  std::vector<double> stack_;     // what is left for fronts to come
  std::vector<int> waiting_;      // whose that is
  std::vector<int> place_;        // of a row of L in the front at work
  std::vector<int> child_rows_;   // those of a child
  std::vector<double> solution_;  // see Kernels::solve_double
};

}  // namespace drape
