#include "sim/simulation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/effects/effect.hpp"
#include "sim/stability.hpp"

namespace drape {
namespace {

/// Makes the integrator, unless the motion is known beforehand to be unstable.
std::unique_ptr<Integrator> make_stable_integrator(const SimulationSettings& settings, const System& system) {
  if (!settings.integrator.allow_unstable) {
    if (const auto problem = stability_problem(settings, system)) throw UsageError(*problem);
  }
  return make_integrator(settings.integrator, system);
}

State initial_state(const Cloth& cloth) {
  State state{.x = cloth.positions, .v = cloth.velocities, .step = 0};
  for (const int pin : cloth.pins) state.v.row(pin).setZero();
  return state;
}

}  // namespace

System make_system(const SimulationSettings& settings) {
  System system(settings.cloth, settings.step);
  for (const ActiveEffect& active : settings.effects) active.effect->install(system);
  return system;
}

DivergedError::DivergedError(std::int64_t step, double time, int vertex)
    : Error(ExitCode::diverged,
            fmt::format(
                "the simulation diverged at step {} (t = {:g} s), first seen at vertex {}: a smaller [time] step, "
                "or an implicit method, keeps it stable",
                step, time, vertex)) {}

Simulation::Simulation(SimulationSettings settings)
    : settings_(std::move(settings)),
      system_(make_system(settings_)),
      state_(initial_state(settings_.cloth)),
      constant_force_(Vertices::Zero(settings_.cloth.vertex_count(), 3)),
      force_(constant_force_),
      integrator_(make_stable_integrator(settings_, system_)),
      springs_(system_.springs, settings_.cloth.vertex_count()) {
  for (const auto& force : system_.forces) {
    if (force->constant()) force->add(state_, 0, constant_force_);
  }
}

Simulation::~Simulation() = default;

StepReport Simulation::step() {
  const StepReport report = integrator_->advance(state_, force());
  ++state_.step;
  // What is not finite makes the sum of its squares so, and any velocity that is not moves its vertex there.
  if (!std::isfinite(norm(state_.x))) throw_diverged();
  return report;
}

const Vertices& Simulation::force() {
  if (std::all_of(system_.forces.begin(), system_.forces.end(), [](const auto& f) { return f->constant(); })) {
    return constant_force_;
  }
  force_ = constant_force_;
  for (const auto& force : system_.forces) {
    if (!force->constant()) force->add(state_, time(), force_);
  }
  return force_;
}

void Simulation::restore(const State& state) { state_ = state; }

Energies Simulation::energies() const {
  const Eigen::VectorXd& m = settings_.cloth.masses;
  return {.kinetic = 0.5 * m.dot(state_.v.rowwise().squaredNorm()),
          .gravity = -m.dot(state_.x * system_.gravity),
          .elastic = springs_.energy(state_.x)};
}

std::vector<Collider> Simulation::colliders(double time) const {
  std::vector<Collider> shapes;
  for (const auto& motion : system_.colliders) shapes.push_back(motion->at(time));
  return shapes;
}

void Simulation::throw_diverged() const {
  Eigen::Index worst = 0;
  double fastest = -1;
  for (Eigen::Index i = 0; i < state_.v.rows(); ++i) {
    const double speed = state_.v.row(i).norm();
    if (!std::isfinite(speed) || !state_.x.row(i).allFinite()) {
      worst = i;
      break;
    }
    if (speed > fastest) {
      fastest = speed;
      worst = i;
    }
  }
  throw DivergedError(state_.step, time(), static_cast<int>(worst));
}

}  // namespace drape
