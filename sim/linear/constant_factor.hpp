#pragma once

#include <vector>

#include "sim/kernels/kernels.hpp"
#include "sim/linear/free_vertices.hpp"
#include "sim/linear/solve_tree.hpp"
#include "sim/linear/sparse_cholesky.hpp"
#include "sim/system.hpp"

namespace drape {

/// The numbers that a factor's triangles are stored and solved in. Whoever solves for an increment loses no accuracy by
/// single precision: the next increment corrects the error of this one.
enum class Precision { automatic, single_precision, double_precision };

/// A⁻¹ for the constant matrix of Liu et al. 2013 (their M + h²L, divided by h²):
///   A = M/h² + Σ k (eᵢ − eⱼ)(eᵢ − eⱼ)ᵀ + the bounds of the system's energies,
/// over the free vertices; the same n×n matrix for x, y and z. No Hessian of g exceeds it, so x − A⁻¹∇g(x) is the
/// local/global step, and it never raises g.
///
/// The factor consists of panels of neighbouring columns: CHOLMOD's columns repacked, or from 20 000 free vertices on
/// those of MultifrontalCholesky, whose bits differ. The three right-hand sides are solved side by side in one pass
/// over it, by the system's threads in parts of it (SolveTree).
class ConstantFactor {
 public:
  /// @param duration of an implicit step, h [s]
  /// @param precision automatic: single, unless solving two test vectors shows that it loses more than a thousandth
  ConstantFactor(const System& system, double duration, Precision precision);

  /// x = A⁻¹ b for n×3 numbers; rows of pins are ignored in b and zero in x. Allocates nothing. [N] → [m]
  void solve(const Vertices& b, Vertices& x);
  /// x −= A⁻¹ b, the same numbers in one pass less; returns ‖A⁻¹ b‖.
  double subtract_solution(const Vertices& b, Vertices& x);

  [[nodiscard]] bool single_precision() const { return !single_.values.empty(); }
  /// Numbers stored for L, the zeros within panels included.
  [[nodiscard]] std::size_t entries() const { return entries_; }
  /// Multiplications and additions that computing L takes: Σ c² over columns of c entries.
  [[nodiscard]] double operations() const;
  /// In how many parts it is solved, see SolveTree.
  [[nodiscard]] int parts() const { return tree_.size(); }

 private:
  template <class T>
  struct Triangle {
    std::vector<T> values;   // see PackedTriangle
    std::vector<T> scratch;  // x, y, z and nothing of each place
  };

  // Two ways to a factor in double precision. They return whether the matrix is positive definite.
  [[nodiscard]] bool factor_columns(const LowerPattern& pattern, const std::vector<double>& values, const Stop& stop,
                                    const FreeVertices& free);
  [[nodiscard]] bool factor_fronts(const LowerPattern& pattern, const std::vector<double>& values, const System& system,
                                   const FreeVertices& free);
  void number_rows(const int* permutation, const FreeVertices& free);
  void find_panels(const SparseCholesky::Columns& columns);
  void copy(const SparseCholesky::Columns& columns);
  /// Divides the panels that have been found, and gives each vertex its place.
  void find_places();
  template <class T>
  void solve_packed(Triangle<T>& triangle, const Vertices& b) const;
  template <class T>
  void solve_with(Triangle<T>& triangle, const Vertices& b, Vertices& x) const;
  [[nodiscard]] bool single_suffices();

  const Threads& threads_;
  int vertex_count_;
  std::size_t entries_ = 0;
  int row_count_ = 0;     // of L
  std::vector<int> row_;  // of each vertex, and then its place in memory; those of pins come last
  std::vector<Panel> panels_;
  std::vector<int> rows_;  // below each panel, one panel after another
  SolveTree tree_;
  int place_count_ = 0;  // with pins
  Triangle<float> single_;
  Triangle<double> double_;
};

}  // namespace drape
