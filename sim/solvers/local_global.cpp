#include "sim/solvers/local_global.hpp"

namespace drape {
namespace {

constexpr int local_global_iterations = 100;  // the homework's

}  // namespace

LocalGlobal::LocalGlobal(const System& system, const StepObjective& objective, const IntegratorSettings& settings)
    : Minimiser(objective, settings, local_global_iterations),
      factor_(system, objective.duration(), Precision::automatic) {}

double LocalGlobal::iterate(Point& point) {
  const double change = factor_.subtract_solution(point.gradient, point.x);
  point.value = objective().evaluate(point.x, point.gradient);
  return change;
}

}  // namespace drape
