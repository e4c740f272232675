#include "sim/integrators/liu13.hpp"

namespace drape {
namespace {

constexpr int liu13_iterations = 100;  // the homework's

}  // namespace

Liu13::Liu13(const System& system, const IntegratorSettings& settings)
    : ImplicitEuler(system, settings, liu13_iterations), factor_(system, Precision::automatic) {}

double Liu13::iterate(Point& point) {
  const double change = factor_.subtract_solution(point.gradient, point.x);
  point.value = objective().evaluate(point.x, point.gradient);
  return change;
}

}  // namespace drape
