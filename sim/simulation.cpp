#include "sim/simulation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/effects/effect.hpp"
#include "sim/stability.hpp"
#include "sim/timed_effects.hpp"

namespace drape {
namespace {

bool is_explicit(const SimulationSettings& settings) { return settings.integrator.method == Method::semi_implicit; }

/// Makes the integrator, unless the motion is known beforehand to be unstable.
/// @param safe_step of semi-implicit Euler, which takes a while to find
std::unique_ptr<Integrator> make_stable_integrator(const SimulationSettings& settings, const System& system,
                                                   double safe_step) {
  if (!settings.integrator.allow_unstable) {
    const auto problem =
        is_explicit(settings) ? step_problem(settings.step, safe_step) : stability_problem(settings, system);
    if (problem) throw UsageError(*problem);
  }
  return make_integrator(settings.integrator, system);
}

State initial_state(const Cloth& cloth) {
  State state{.x = cloth.positions, .v = cloth.velocities, .step = 0};
  for (const int pin : cloth.pins) state.v.row(pin).setZero();
  return state;
}

Vertices constant_force(const System& system, const State& state) {
  Vertices sum = Vertices::Zero(state.x.rows(), 3);
  for (const auto& force : system.forces) {
    if (force->constant()) force->add(state, 0, sum);
  }
  return sum;
}

}  // namespace

System make_system(const SimulationSettings& settings, std::vector<double>* effect_seconds) {
  System system(settings.cloth, settings.step);
  for (std::size_t i = 0; i < settings.effects.size(); ++i) {
    const SystemSizes before(system);
    settings.effects[i].effect->install(system);
    if (effect_seconds != nullptr) time_additions(system, before, (*effect_seconds)[i]);
  }
  return system;
}

Simulation::Simulation(SimulationSettings settings, Timing timing)
    : settings_(std::move(settings)),
      effect_seconds_(timing == Timing::effects ? settings_.effects.size() : 0, 0.0),
      system_(make_system(settings_, timing == Timing::effects ? &effect_seconds_ : nullptr)),
      phases_(pin_phases(settings_.cloth.pins, system_->pin_releases)),
      state_(initial_state(settings_.cloth)),
      constant_force_(constant_force(*system_, state_)),
      force_(constant_force_),
      safe_step_(is_explicit(settings_) ? safe_step(*system_) : 0),
      integrator_(make_stable_integrator(settings_, *system_, safe_step_)),
      springs_(system_->springs, settings_.cloth.vertex_count()) {
  if (!is_explicit(settings_)) return;
  // What pins and filters do to the cloth is no force. Beyond the safe step that does not count.
  if (settings_.step > safe_step_ || (system_->pin_motions.empty() && system_->filters.empty())) {
    watch_.emplace(*system_, safe_step_);
    restore(state_);
  }
}

Simulation::~Simulation() = default;

void Simulation::enter_phase() {
  std::size_t now = phases_.size() - 1;
  while (phases_[now].first_step > state_.step) --now;
  if (now == phase_) return;
  integrator_.reset();  // it refers to the system
  phase_ = now;
  settings_.cloth.pins = phases_[now].pins;
  system_.emplace(make_system(settings_, effect_seconds_.empty() ? nullptr : &effect_seconds_));
  integrator_ = make_integrator(settings_.integrator, *system_);
}

StepReport Simulation::step() {
  if (phases_.size() > 1) enter_phase();
  const Vertices& push = force();
  StepReport report = integrator_->advance(state_, push);
  for (const auto& filter : system_->filters) report.converged = report.converged && filter->converged();
  ++state_.step;
  // What is not finite makes the sum of its squares so, and any velocity that is not moves its vertex there.
  if (!std::isfinite(norm(state_.x))) throw diverged_with(std::nullopt);
  if (watch_) look_for_blow_up(push);
  return report;
}

void Simulation::look_for_blow_up(const Vertices& push) {
  const bool constant = &push == &constant_force_;
  if (!constant) work_ += settings_.step * std::abs(push.cwiseProduct(state_.v).sum());
  if (state_.step % watch_->interval() != 0) return;
  if (constant) work_ = std::abs(push.cwiseProduct(state_.x - looked_at_).sum());
  const Energies now = energies();
  if (const auto growth = watch_->look(work_, now.kinetic + now.elastic)) throw diverged_with(growth);
  looked_at_ = state_.x;
  work_ = 0;
}

DivergedError Simulation::diverged_with(std::optional<double> growth) const {
  BlowUp what{.growth = growth, .safe_step = {}, .step = settings_.step};
  if (is_explicit(settings_)) what.safe_step = safe_step_;
  return diverged(state_, time(), what);
}

const Vertices& Simulation::force() {
  const auto& forces = system_->forces;
  if (std::all_of(forces.begin(), forces.end(), [](const auto& f) { return f->constant(); })) {
    return constant_force_;
  }
  force_ = constant_force_;
  for (const auto& force : forces) {
    if (!force->constant()) force->add(state_, time(), force_);
  }
  return force_;
}

void Simulation::restore(const State& state) {
  state_ = state;
  if (!watch_) return;
  const Energies now = energies();
  watch_->begin(now.kinetic + now.elastic);
  looked_at_ = state_.x;
  work_ = 0;
}

Energies Simulation::energies() const {
  const Eigen::VectorXd& m = settings_.cloth.masses;
  ignored_.setZero(state_.x.rows(), 3);
  double elastic = springs_.add_value_gradient(state_.x, ignored_);
  for (const auto& energy : system_->coupled_energies) elastic += energy->add_gradient(state_.x, ignored_);
  per_vertex_ = state_.v.rowwise().squaredNorm();
  const double kinetic = 0.5 * m.dot(per_vertex_);
  per_vertex_.noalias() = state_.x * system_->gravity;
  return {.kinetic = kinetic, .gravity = -m.dot(per_vertex_), .elastic = elastic};
}

std::vector<Collider> Simulation::colliders(double time) const {
  std::vector<Collider> shapes;
  for (const auto& motion : system_->colliders) shapes.push_back(motion->at(time));
  return shapes;
}

}  // namespace drape
