#pragma once

#include <memory>

#include "sim/linear/constant_factor.hpp"
#include "sim/linear/newton_solver.hpp"
#include "sim/solvers/minimiser.hpp"

namespace drape {

/// A minimiser whose only Hessian model is Liu13's factored matrix A.
class FactoredMinimiser : public Minimiser {
 public:
  FactoredMinimiser(const System& system, const StepObjective& objective, const IntegratorSettings& settings,
                    int default_max_iterations);
  ConstantFactor& constant_factor() override { return factor_; }

 protected:
  ConstantFactor& factor() { return factor_; }
  void find_newton_step(const Iterate& point, Vertices& direction) override;

 private:
  const System& system_;
  ConstantFactor factor_;
  std::unique_ptr<ConjugateGradients> newton_;  // created on first use
};

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
