#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sim/linear/constant_factor.hpp"
#include "sim/linear/hessian_diagonal.hpp"
#include "sim/linear/newton_solver.hpp"
#include "sim/step_objective.hpp"

namespace drape {

/// Newton's equations by conjugate gradients, preconditioned with Liu13's factored matrix A. H never exceeds A, and
/// falls below it by at most 1 + h²λ_max(M⁻¹L), so the iterations are few where Newton's method is stiff but not
/// extremely so. H is never assembled: its springs' blocks are kept as vectors, and a product is one pass over them.
///
/// The preconditioner of a fine cloth is A⁻¹ + D⁻¹, D the HessianDiagonal. What falls far below A are motions out of
/// the cloth's plane, which nothing but inertia holds where it is not stretched; those that neighbours do not share
/// fall less below D. As no Hessian exceeds A or D, the sum never exceeds 2 H⁻¹.
class ConjugateGradients final : public NewtonSolver {
 public:
  /// Far beyond what the worst scenes need. What is reached by then is still a direction of descent.
  static constexpr int most_iterations = 1000;

  /// @param preconditioner A of the same system, which must outlive this. Without it one is made, and the equations are
  ///                       solved for Newton's method; with it for estimates, of a fine cloth to about a tenth
  ConjugateGradients(const System& system, const StepObjective& objective, ConstantFactor* preconditioner = nullptr);
  void solve(const Vertices& x, const Vertices& gradient, double concavity, Vertices& direction) override {
    static_cast<void>(solve_within(most_iterations, x, gradient, concavity, direction));
  }
  /// The same in so many iterations at most. Returns whether that was enough.
  [[nodiscard]] bool solve_within(int iterations, const Vertices& x, const Vertices& gradient, double concavity,
                                  Vertices& direction);

  /// How many iterations take as long as to assemble H and to factor it. Counted, and so the same on every
  /// machine.
  [[nodiscard]] int worth_a_factor() const;

 private:
  void linearise(const Vertices& x, double concavity);
  /// Whether an estimate is about as long as it will be, after another iteration.
  [[nodiscard]] bool hardly_grows(const Vertices& direction);
  /// preconditioned = that of the residual.
  void precondition();
  void apply(const Vertices& vector, Vertices& product) const;

  const System& system_;
  const StepObjective& objective_;
  std::unique_ptr<ConstantFactor> own_;  // unless it is given
  ConstantFactor& preconditioner_;
  std::size_t pair_count_ = 0;  // coupled by springs and energies
  SpringNetwork::Blocks blocks_;
  std::vector<std::unique_ptr<EnergyHessian>> hessians_;  // of the system's energies
  std::optional<HessianDiagonal> diagonal_;               // of a large cloth
  bool estimates_ = false;                                // of a large cloth, for a preconditioner's owner
  double tolerance_;                                      // of the residual, of the gradient
  std::vector<double> lengths_;                           // of an estimate, after each iteration
  Vertices residual_, preconditioned_, search_, product_;
};

}  // namespace drape
