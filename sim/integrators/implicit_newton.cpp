#include "sim/integrators/implicit_newton.hpp"

namespace drape {
namespace {

constexpr int default_max_iterations = 20;  // the homework's

}  // namespace

ImplicitNewton::ImplicitNewton(const System& system, const IntegratorSettings& settings)
    : ImplicitEuler(system, settings, default_max_iterations),
      newton_(system),
      direction_(system.cloth.vertex_count(), 3) {}

double ImplicitNewton::iterate(Point& point) {
  newton_.factorize(point.x);
  newton_.solve(point.gradient, direction_);
  return descend(point, direction_, dot(point.gradient, direction_)) * norm(direction_);
}

}  // namespace drape
