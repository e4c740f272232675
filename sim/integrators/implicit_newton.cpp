#include "sim/integrators/implicit_newton.hpp"

namespace drape {
namespace {

constexpr int default_max_iterations = 20;    // the homework's
constexpr double sufficient_decrease = 1e-4;  // Armijo's constant, as usual (Nocedal and Wright 2006, section 3.1)
constexpr double smallest_step = 1e-10;

}  // namespace

ImplicitNewton::ImplicitNewton(const System& system, const IntegratorSettings& settings)
    : ImplicitEuler(system, settings, default_max_iterations),
      newton_(system),
      direction_(system.cloth.vertex_count(), 3),
      trial_(system.cloth.vertex_count(), 3) {}

double ImplicitNewton::iterate(Vertices& x, const Vertices& gradient) {
  newton_.factorize(x);
  newton_.solve(gradient, direction_);
  const double slope = gradient.cwiseProduct(direction_).sum();
  const double before = objective().value(x);
  for (double length = 1; length >= smallest_step; length /= 2) {
    trial_ = x - length * direction_;
    // Near the minimum g changes by less than it can be computed to; the direction is trusted there.
    if (objective().value(trial_) <= before - sufficient_decrease * length * slope + StepObjective::rounding(before)) {
      x = trial_;
      return length * direction_.norm();
    }
  }
  return 0;
}

}  // namespace drape
