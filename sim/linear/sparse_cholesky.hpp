#pragma once

#include <memory>
#include <vector>

#include "drape/core/error.hpp"
#include "drape/sim/cloth.hpp"
#include "sim/system.hpp"

namespace drape {

/// The lower triangle of a symmetric n×n matrix by columns. The rows of column c are rows[starts[c]] to
/// rows[starts[c+1]−1], ascending from c itself.
struct LowerPattern {
  std::vector<int> starts;  ///< n+1
  std::vector<int> rows;

  [[nodiscard]] int size() const { return static_cast<int>(starts.size()) - 1; }
  [[nodiscard]] int entries() const { return starts.back(); }
  bool operator==(const LowerPattern&) const = default;
};

/// Thrown for a factor that takes far longer than that of a surface. It depends on the cloth alone, not on the
/// machine's memory.
class FactorTooExpensive : public UsageError {
 public:
  using UsageError::UsageError;
};

/// Rejects the factor of a graph unlike a surface's, which could take minutes without any progress report.
/// @param operations multiplications and additions for the factor
/// @param always     number of operations that any graph may take
/// @throws FactorTooExpensive
void require_surface(double rows, double operations, double always);

/// The Cholesky factorisation A = Pᵀ L Lᵀ P of a sparse symmetric positive-definite matrix, by CHOLMOD (Chen et al.
/// 2008), column by column, with the same bits on every machine. The sparsity is analysed once; the values may change.
class SparseCholesky {
 public:
  /// Analyses the pattern, and chooses a permutation.
  /// @param caller_bytes kept by the caller for each entry of the factor
  /// @throws UsageError if the factor cannot fit into memory, or takes far longer than that of a surface
  explicit SparseCholesky(const LowerPattern& pattern, double caller_bytes = 0);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// Computes the factor of the matrix whose lower triangle has these values, in the order of the pattern.
  /// @return false if it is not positive definite to working precision
  [[nodiscard]] bool factorize(const double* values);

  /// Returns the order of the rows, n numbers: row r of L is row permutation()[r] of A.
  [[nodiscard]] const int* permutation() const;

  /// The factor L by columns, with the diagonal first in each.
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

/// Number of free vertices from which ConstantFactor uses its own factorisation.
inline constexpr int large_cloth = 20'000;
/// Number of free vertices from which more knowledge of the Hessian pays off: conjugate gradients use its diagonal
/// (HessianDiagonal), and quasi-Newton takes some Newton steps. Smaller cloth keeps the bits of former versions.
inline constexpr int fine_cloth = 1'000;

/// The unknowns of an implicit step: the unpinned vertices, numbered from 0 in the order of the cloth. This is the
/// selection matrix of the reduced system.
class FreeVertices {
 public:
  explicit FreeVertices(const Cloth& cloth);

  [[nodiscard]] int count() const { return static_cast<int>(vertices_.size()); }
  /// Returns the vertex of a free number.
  [[nodiscard]] int vertex(int number) const { return vertices_[static_cast<std::size_t>(number)]; }
  /// Returns the free number of a vertex, −1 for a pin.
  [[nodiscard]] int number(int vertex) const { return numbers_[static_cast<std::size_t>(vertex)]; }

  /// Returns their positions in the rest shape, or the initial ones if there is none, n×3 [m].
  [[nodiscard]] Vertices rest_places(const Cloth& cloth) const;

 private:
  std::vector<int> vertices_, numbers_;
};

/// Returns the lower triangle of a matrix that couples the free ends of every pair, with its whole diagonal.
LowerPattern spring_pattern(const StiffnessBound& bound, const FreeVertices& free);

}  // namespace drape
