#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sim/linear/constant_factor.hpp"
#include "sim/linear/hessian_diagonal.hpp"
#include "sim/linear/newton_solver.hpp"
#include "sim/step_objective.hpp"

namespace drape {

/// Solver of Newton's equations by conjugate gradients, preconditioned with Liu13's factored matrix A. H never exceeds
/// A, and is smaller by at most 1 + h²λ_max(M⁻¹L). So the iterations are few unless Newton's method is extremely stiff.
/// H is never assembled: the blocks of its springs are kept as vectors, and a product is one pass over them.
///
/// The preconditioner of a fine cloth is A⁻¹ + D⁻¹, with the HessianDiagonal D. H is far below A for motions out of the
/// cloth's plane, which only inertia resists if the cloth is not stretched. Such motions of single vertices are less
/// far below D. Both A and D bound every Hessian, so the sum never exceeds 2 H⁻¹.
class ConjugateGradients final : public NewtonSolver {
 public:
  /// Far above the needs of the worst scenes. The result after this many is still a descent direction.
  static constexpr int most_iterations = 1000;

  /// @param preconditioner A of the same system; must outlive this. Without it one is made for Newton's method; with it
  ///                       solves are estimates, to about a tenth for a fine cloth
  ConjugateGradients(const System& system, const StepObjective& objective, ConstantFactor* preconditioner = nullptr);
  void solve(const Vertices& x, const Vertices& gradient, double concavity, Vertices& direction) override {
    static_cast<void>(solve_within(most_iterations, x, gradient, concavity, direction));
  }
  /// Solves within a number of iterations. Returns true if that was enough.
  [[nodiscard]] bool solve_within(int iterations, const Vertices& x, const Vertices& gradient, double concavity,
                                  Vertices& direction);

  /// Returns the number of iterations that cost as much as assembling and factoring H. It is counted, so the same on
  /// every machine.
  [[nodiscard]] int worth_a_factor() const;

 private:
  void linearise(const Vertices& x, double concavity);
  /// Returns true if the length of an estimate has almost stopped growing.
  [[nodiscard]] bool has_stagnated(const Vertices& direction);
  /// Sets preconditioned_ from the residual.
  void precondition();
  void apply(const Vertices& vector, Vertices& product) const;

  const System& system_;
  const StepObjective& objective_;
  std::unique_ptr<ConstantFactor> own_;  // if none is given
  ConstantFactor& preconditioner_;
  std::size_t pair_count_ = 0;  // pairs coupled by springs and energies
  SpringNetwork::Blocks blocks_;
  std::vector<std::unique_ptr<EnergyHessian>> hessians_;  // of the system's energies
  std::optional<HessianDiagonal> diagonal_;               // for a fine cloth
  bool estimates_ = false;                                // true for a fine cloth with a given preconditioner
  double tolerance_;                                      // of the residual, relative to the gradient
  std::vector<double> lengths_;                           // length of an estimate after each iteration
  Vertices residual_, preconditioned_, search_, product_;
};

}  // namespace drape
