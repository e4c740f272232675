#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "drape/sim/mesh.hpp"
#include "sim/linear/constant_factor.hpp"
#include "sim/step_objective.hpp"

namespace drape {

/// Solver of Newton's equations H(x) p = ∇g(x) over the free vertices. H is the Hessian of g with a fraction of its
/// negative eigenvalues (sim/kernels/kernels.hpp).
class NewtonSolver {
 public:
  virtual ~NewtonSolver() = default;

  /// Resets for another minimisation, so that earlier ones have no influence.
  virtual void begin() {}

  /// Computes a descent direction = H(x)⁻¹ gradient, n×3 and zero on pins. [N] → [m]
  /// Zero everywhere if H is not finite.
  /// @param concavity largest fraction; if H is not positive definite with it, a smaller one or only a part of H is
  ///                  used
  virtual void solve(const Vertices& x, const Vertices& gradient, double concavity, Vertices& direction) = 0;
};

/// A block-diagonal upper bound D ⪰ H of the Hessian: one 3×3 block per vertex, m/h² I + 2 Σ K over its springs, plus
/// the energies' bounds. It holds because (eᵢ − eⱼ)(eᵢ − eⱼ)ᵀ ⊗ K is at most 2 K at either end. Unlike A it depends on
/// the directions of the springs.
class HessianDiagonal {
 public:
  /// @param objective of every step; must outlive this
  HessianDiagonal(const System& system, const StepObjective& objective);

  /// Uses the Hessian of the springs as computed by the objective's SpringNetwork.
  void linearise(const SpringNetwork::Blocks& springs);

  /// Adds D⁻¹ b to x for n×3 numbers, zero on pins. [N] → [m]
  void add_solution(const Vertices& b, Vertices& x) const;

 private:
  const StepObjective& objective_;
  Eigen::VectorXd scalar_;  // of inertia and energies [N/m]
  /// Factor L D Lᵀ of each block: 1/d₁, l₂₁, l₃₁, 1/d₂, l₃₂, 1/d₃.
  Eigen::Matrix<double, Eigen::Dynamic, 6> factor_;
};

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
