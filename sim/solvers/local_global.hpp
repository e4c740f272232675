#pragma once

#include "sim/solvers/factored_minimiser.hpp"

namespace drape {

/// The local/global alternation of Liu, Bargteil, O'Brien and Kavan, "Fast Simulation of Mass-Spring Systems", 2013.
/// The local step is d = L·x̂ for every spring, the global step (M + h²L)x' = h²Jd + My. With A = M/h² + L both are
/// computed together as x' = x − A⁻¹∇g(x), since ∇g(x) = A x − (J d + M y/h²) at the d of the local step.
class LocalGlobal final : public FactoredMinimiser {
 public:
  LocalGlobal(const System& system, const StepObjective& objective, const IntegratorSettings& settings);

  [[nodiscard]] ImplicitHessian hessian() const override { return ImplicitHessian::constant; }

 private:
  double iterate(Iterate& point) override;
};

}  // namespace drape
