#pragma once

#include "sim/step_objective.hpp"

namespace drape {

/// A bound D ⪰ H of the Hessian at a place that couples no vertices: one 3×3 block for each, m/h² I + 2 Σ K over its
/// springs, and what bounds the Hessians of the energies. It bounds them as (eᵢ − eⱼ)(eᵢ − eⱼ)ᵀ ⊗ K is at most 2 K at
/// either end. Unlike A it knows in which directions a vertex is held.
class HessianDiagonal {
 public:
  /// @param objective of every step, which must outlive this
  HessianDiagonal(const System& system, const StepObjective& objective);

  /// Takes the Hessian of the springs at a place, as the objective's SpringNetwork has computed it.
  void linearise(const SpringNetwork::Blocks& springs);

  /// x += D⁻¹ b for n×3 numbers, zero on pins. [N] → [m]
  void add_solution(const Vertices& b, Vertices& x) const;

 private:
  const StepObjective& objective_;
  Eigen::VectorXd scalar_;  // of inertia and energies [N/m]
  /// Of each block L D Lᵀ: 1/d₁, l₂₁, l₃₁, 1/d₂, l₃₂, 1/d₃.
  Eigen::Matrix<double, Eigen::Dynamic, 6> factor_;
};

}  // namespace drape
