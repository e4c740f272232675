#pragma once

#include <memory>
#include <vector>

#include "core/error.hpp"

namespace drape {

/// The lower triangle of a symmetric n×n matrix by columns: the rows of column c are rows[starts[c]] to
/// rows[starts[c+1]−1], ascending and beginning with c itself.
struct LowerPattern {
  std::vector<int> starts;  ///< n+1
  std::vector<int> rows;

  [[nodiscard]] int size() const { return static_cast<int>(starts.size()) - 1; }
  [[nodiscard]] int entries() const { return starts.back(); }
};

/// What takes far longer to factor than a surface: it depends on the cloth alone, unlike whether a factor fits into
/// memory.
class UnlikeASurface : public UsageError {
 public:
  using UsageError::UsageError;
};

/// Refuses the factor of a graph that is no surface's before minutes go by without a sign.
/// @param operations it takes, multiplications and additions
/// @param always     so many are allowed for any graph
/// @throws UnlikeASurface
void require_surface(double rows, double operations, double always);

/// The Cholesky factorisation A = Pᵀ L Lᵀ P of a sparse symmetric positive-definite matrix, by CHOLMOD (Chen et al.
/// 2008), column by column, with the same bits on every machine. The sparsity is analysed once; the values may change.
class SparseCholesky {
 public:
  /// Analyses the pattern, and chooses a permutation.
  /// @param caller_bytes that the caller will keep for each entry of the factor
  /// @throws UsageError if the factor cannot fit into memory, or takes far longer than one of a surface
  explicit SparseCholesky(const LowerPattern& pattern, double caller_bytes = 0);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// Computes the factor of the matrix whose lower triangle has these values, in the order of the pattern.
  /// @return false if it is not positive definite to working precision
  [[nodiscard]] bool factorize(const double* values);

  /// The order that the rows were brought into, n numbers: row r of L belongs to row permutation()[r] of A.
  [[nodiscard]] const int* permutation() const;

  /// The factor itself: L by columns, the diagonal first in each.
  struct Columns {
    const int* starts;  ///< n
    const int* counts;  ///< n
    const int* rows;
    const double* values;
  };
  [[nodiscard]] Columns columns() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace drape
