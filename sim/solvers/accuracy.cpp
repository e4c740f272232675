#include "drape/sim/solvers/accuracy.hpp"

#include <algorithm>
#include <array>

#include "sim/step_objective.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

constexpr double visible = 1e-4;                  // fraction of the cloth's size
constexpr double tolerated = 0.003;               // fraction of the largest displacement by forces in a step
constexpr std::array share_of_forces{0.1, 0.05};  // fraction of the displacement by forces, by order of the scheme
constexpr double share_of_way = 0.01;
constexpr double customary = 1e-3;  // the homework's tolerance for a rule given without one [m] or [N]

double longest(const Vertices& v) { return v.rowwise().stableNorm().maxCoeff(); }

StoppingRule rule_of(const IntegratorSettings& settings) {
  return settings.stop.value_or(settings.tolerance ? StoppingRule::change : StoppingRule::error);
}

/// Returns the forces of the springs at the start, n×3 [N].
Vertices spring_forces(const System& system) {
  const Vertices& x = system.cloth.positions;
  Vertices force = Vertices::Zero(x.rows(), 3);
  for (const Spring& spring : system.springs) {
    const Eigen::RowVector3d d = x.row(spring.j) - x.row(spring.i);
    const double length = d.stableNorm();
    if (length == 0) continue;
    const Eigen::RowVector3d pull = spring.stiffness * (length - spring.rest_length) / length * d;
    force.row(spring.i) += pull;
    force.row(spring.j) -= pull;
  }
  return force;
}

/// Returns the largest displacement of a vertex in a step by forces or velocities [m]; 0 if nothing moves.
double way_in_a_step(const System& system, const Eigen::VectorXd& inertia) {
  const State start{.x = system.cloth.positions, .v = system.cloth.velocities, .step = 0};
  const auto moved = [&](Vertices force) {
    force.array().colwise() /= inertia.array();
    for (const int pin : system.cloth.pins) force.row(pin).setZero();
    return longest(force);
  };
  Vertices force = Vertices::Zero(start.x.rows(), 3);
  for (const auto& each : system.forces) {
    if (each->constant()) each->add(start, 0, force);
  }
  if (const double way = moved(force); way > 0) return way;
  for (const auto& each : system.forces) {
    if (!each->constant()) each->add(start, 0, force);
  }
  for (const auto& field : system.fields) field->add(start, 0, force);
  return std::max(moved(force + spring_forces(system)), system.step * longest(start.v));
}

double default_error(const System& system, const Eigen::VectorXd& inertia) {
  const double seen = visible * size_of(system.cloth);
  const double way = way_in_a_step(system, inertia);
  return way > 0 ? std::min(seen, tolerated * way) : seen;
}

}  // namespace

int default_iterations(const IntegratorSettings& settings, int otherwise) {
  return rule_of(settings) == StoppingRule::error ? 2000 : otherwise;
}

Accuracy::Accuracy(const IntegratorSettings& settings, const System& system, const Eigen::VectorXd& inertia)
    : rule(rule_of(settings)),
      tolerance(settings.tolerance.value_or(customary)),
      is_default(!settings.tolerance && rule == StoppingRule::error),
      order(order_of({settings.method, settings.scheme})),
      limit(system.solve_limit * system.cloth.masses[0] / inertia[0]) {
  if (is_default) tolerance = std::min(default_error(system, inertia), limit);
}

double Accuracy::tolerance_at(const StepObjective& objective, const Vertices& x, double start_error) const {
  if (!is_default) return tolerance;
  const auto [total, by_forces] = objective.largest_displacement(x);
  const double changed = start_error < by_forces ? std::pow(start_error / by_forces, order) : 1;
  const double of_scheme = share_of_forces.at(static_cast<std::size_t>(order - 1)) * changed * by_forces;
  return std::max(std::min({of_scheme, share_of_way * total, limit}), objective.error_rounding());
}

}  // namespace drape
