#include "sim/solvers/factored_minimiser.hpp"

namespace drape {

FactoredMinimiser::FactoredMinimiser(const System& system, const StepObjective& objective,
                                     const IntegratorSettings& settings, int default_max_iterations)
    : Minimiser(system, objective, settings, default_max_iterations),
      system_(system),
      factor_(system, objective.duration(), Precision::automatic) {}

void FactoredMinimiser::find_newton_step(const Iterate& point, Vertices& direction) {
  if (!newton_) newton_ = std::make_unique<ConjugateGradients>(system_, objective(), &factor_);
  newton_->solve(point.x, point.gradient, 0, direction);
}

}  // namespace drape
