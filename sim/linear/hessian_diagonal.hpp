#pragma once

#include "sim/step_objective.hpp"

namespace drape {

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

}  // namespace drape
