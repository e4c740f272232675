#pragma once

#include <vector>

#include "sim/kernels/kernels.hpp"
#include "sim/linear/solve_tree.hpp"
#include "sim/linear/sparse_cholesky.hpp"
#include "sim/system.hpp"

namespace drape {

/// Number type in which a factor is stored and solved. Single precision costs no accuracy in iterative corrections: the
/// next increment corrects the error of this one.
enum class Precision { automatic, single_precision, double_precision };

/// A⁻¹ for the constant matrix of Liu et al. 2013 (their M + h²L, divided by h²):
///   A = M/h² + Σ k (eᵢ − eⱼ)(eᵢ − eⱼ)ᵀ + the bounds of the system's energies,
/// over the free vertices; the same n×n matrix for x, y and z. No Hessian of g exceeds it, so x − A⁻¹∇g(x) is the
/// local/global step and never raises g.
///
/// The factor consists of panels of neighbouring columns. They are CHOLMOD's columns repacked, or for 20 000 free
/// vertices and more those of MultifrontalCholesky, whose bits differ. Three right-hand sides are solved together in
/// one pass over it, in parts on the system's threads (SolveTree).
class ConstantFactor {
 public:
  /// @param duration of an implicit step, h [s]
  /// @param precision automatic: single, unless two test vectors show a relative loss above a thousandth
  ConstantFactor(const System& system, double duration, Precision precision);

  /// Solves x = A⁻¹ b for n×3 numbers; rows of pins are ignored in b and zero in x. Allocates nothing. [N] → [m]
  void solve(const Vertices& b, Vertices& x);
  /// Subtracts A⁻¹ b from x, which saves one pass; returns ‖A⁻¹ b‖.
  double subtract_solution(const Vertices& b, Vertices& x);

  [[nodiscard]] bool single_precision() const { return !single_.values.empty(); }
  /// Returns the numbers stored for L, including zeros within panels.
  [[nodiscard]] std::size_t entries() const { return entries_; }
  /// Returns the operations to compute L, multiplications and additions: Σ c² over columns of c entries.
  [[nodiscard]] double operations() const;
  /// Returns the number of parts of a solve, see SolveTree.
  [[nodiscard]] int parts() const { return tree_.size(); }

 private:
  template <class T>
  struct Triangle {
    std::vector<T> values;   // see PackedTriangle
    std::vector<T> scratch;  // x, y, z and a zero for each place
  };

  // Computes a factor in double precision, in one of two ways. Returns true if the matrix is positive definite.
  [[nodiscard]] bool factor_columns(const LowerPattern& pattern, const std::vector<double>& values, const Stop& stop,
                                    const FreeVertices& free);
  [[nodiscard]] bool factor_fronts(const LowerPattern& pattern, const std::vector<double>& values, const System& system,
                                   const FreeVertices& free);
  void number_rows(const int* permutation, const FreeVertices& free);
  void find_panels(const SparseCholesky::Columns& columns);
  void copy(const SparseCholesky::Columns& columns);
  /// Divides the panels into parts and assigns a place to each vertex.
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
  std::vector<int> row_;  // row of each vertex, later its place in memory; pins come last
  std::vector<Panel> panels_;
  std::vector<int> rows_;  // rows below the panels, one panel after another
  SolveTree tree_;
  int place_count_ = 0;  // including pins
  Triangle<float> single_;
  Triangle<double> double_;
};

}  // namespace drape
