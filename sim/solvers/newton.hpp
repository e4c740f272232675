#pragma once

#include <memory>
#include <vector>

#include "sim/linear/newton_solver.hpp"
#include "sim/parallel/loops.hpp"
#include "sim/solvers/minimiser.hpp"
#include "sim/system.hpp"

namespace drape {

/// Newton's method on g, with a backtracking line search. It starts with the Hessian without its negative eigenvalues,
/// whose directions also descend far from the minimum. After an iteration that did not halve ‖∇g‖, it keeps as many
/// negative eigenvalues as leave the Hessian positive definite. Without them compressed cloth is too stiff and
/// convergence slow; with them convergence is quadratic. The change rule uses the homework's iterations, which never
/// have any.
class Newton final : public Minimiser {
 public:
  Newton(const System& system, const StepObjective& objective, const IntegratorSettings& settings);

 private:
  void start() override;
  double iterate(Iterate& point) override;
  void find_newton_step(const Iterate& point, Vertices& direction) override;

  std::unique_ptr<NewtonSolver> solver_;
  double concavity_ = 0;
  Vertices direction_;
};

/// Newton's method on the patches of a cloth whose error exceeds a tolerance, with fixed surroundings: a block of a
/// nonlinear Gauss-Seidel iteration. Far from a minimum, only a few percent of the vertices have a Hessian unlike A,
/// but these stall methods for the whole cloth. The Hessian of these alone is small enough to factor. The remaining
/// error at the rims of patches is spread out by A⁻¹.
///
/// Supports cloth held together by springs alone, as energies cannot be restricted to a patch.
class PatchNewton {
 public:
  /// Default limit of the fraction of vertices in patches, for which memory is checked.
  static constexpr double usual_share = 0.25;

  /// @param objective of every step; must outlive this
  /// @throws UsageError if the default fraction would not fit into memory
  PatchNewton(const System& system, const StepObjective& objective);

  /// Lowers g by moving the patches: vertices above the tolerance and their neighbours. The result depends only on the
  /// point and the objective.
  /// @param share maximum fraction of vertices in patches, with at most 200 000 vertices; does nothing beyond
  /// @param tolerance of the error of a vertex [m]
  /// @return 2-norm of the moves over all unknowns [m]
  double minimise_patches(Iterate& point, double share, double tolerance);

 private:
  /// Position of a vertex relative to the patches.
  enum class Place : char { outside, rim, inside };

  /// Finds the patches and their vertices, including rims.
  void find_patches(const Vertices& gradient, double tolerance);
  /// Appends all outside neighbours of the vertices from `first` on and marks them with the place.
  void surround(std::size_t first, Place place);
  /// Returns the patches as a cloth at rest at x, pinned at the rims.
  [[nodiscard]] Cloth cut_out(const Vertices& x);

  const System& system_;
  const StepObjective& objective_;
  Incidence springs_at_;       // springs at each vertex
  std::vector<Place> places_;  // per vertex of the cloth
  std::vector<int> vertices_;  // inside and on rims, ascending
  std::vector<int> numbers_;   // index into vertices_ of each of these
  std::size_t inside_ = 0;     // number of vertices inside
};

}  // namespace drape
