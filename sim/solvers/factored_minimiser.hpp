#pragma once

#include <memory>

#include "sim/linear/conjugate_gradients.hpp"
#include "sim/linear/constant_factor.hpp"
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

}  // namespace drape
