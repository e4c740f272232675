#include "sim/solvers/local_global.hpp"

namespace drape {
namespace {

constexpr int local_global_iterations = 100;  // the homework's

}  // namespace

LocalGlobal::LocalGlobal(const System& system, const StepObjective& objective, const IntegratorSettings& settings)
    : FactoredMinimiser(system, objective, settings, local_global_iterations) {}

double LocalGlobal::iterate(Iterate& point) {
  const double change = factor().subtract_solution(point.gradient, point.x);
  point.value = objective().evaluate(point.x, point.gradient);
  return change;
}

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
