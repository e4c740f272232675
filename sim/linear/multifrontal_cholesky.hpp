#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "drape/sim/mesh.hpp"
#include "sim/kernels/kernels.hpp"
#include "sim/linear/solve_tree.hpp"
#include "sim/linear/sparse_cholesky.hpp"

namespace drape {

/// Orders the rows of a matrix by nested dissection (George 1973): halves the cloth across its longer side, numbers the
/// separating vertices last, and recurses into both halves. On a grid of n vertices the factor then has O(n log n)
/// entries and takes O(n^1.5) operations, which is optimal (Lipton, Rose and Tarjan 1979).
/// @param pattern of the matrix
/// @param places  positions of the rows, n×3 [m]; if coupled rows are far apart, there is more fill
/// @returns the rows in order, the same for the same arguments
std::vector<int> dissect(const LowerPattern& pattern, const Vertices& places);

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

/// Number of solves with a factor. For few of them it has larger supernodes, with more zeros: that takes a quarter less
/// time to compute for 1,000 to 10,000 vertices.
enum class Solves { many, few };

/// Returns the supernodes of a matrix's factor, by CHOLMOD's analysis, in postorder of the elimination tree: children
/// before their parent and one after another.
/// @param order of the rows; CHOLMOD renumbers it along the tree. Empty: CHOLMOD chooses one
/// @throws UsageError if the factor has more than 2³¹ entries
Supernodes find_supernodes(const LowerPattern& pattern, const std::vector<int>& order, Solves solves = Solves::many);

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
                                Solves solves = Solves::many, double caller_bytes = 0);

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
