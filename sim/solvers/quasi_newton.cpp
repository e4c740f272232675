#include "sim/solvers/quasi_newton.hpp"

#include "sim/parallel/vectors.hpp"

namespace drape {
namespace {

constexpr int quasi_newton_iterations = 500;

}  // namespace

QuasiNewton::QuasiNewton(const System& system, const StepObjective& objective, const IntegratorSettings& settings)
    : FactoredMinimiser(system, objective, settings, default_iterations(settings, quasi_newton_iterations)),
      history_(system.cloth.vertex_count(), system.threads),
      preconditioned_(Vertices::Zero(system.cloth.vertex_count(), 3)),
      direction_(preconditioned_) {}

void QuasiNewton::start() { history_.clear(); }

double QuasiNewton::iterate(Iterate& point) {
  const Threads& threads = objective().threads();
  factor().solve(point.gradient, preconditioned_);
  history_.observe(point.gradient, preconditioned_);
  history_.find_direction(preconditioned_, direction_);
  double slope = dot(threads, point.gradient, direction_);
  if (!(slope > 0)) {
    // Rounding has spoilt the pairs; A⁻¹∇g itself always descends.
    history_.clear();
    history_.observe(point.gradient, preconditioned_);
    direction_ = preconditioned_;
    slope = dot(threads, point.gradient, direction_);
  }
  const double length = descend(point, direction_, slope);
  history_.moved(direction_, length, slope);
  return length * norm(threads, direction_);
}

}  // namespace drape
