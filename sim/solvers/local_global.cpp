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

}  // namespace drape
