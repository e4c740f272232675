#include "sim/simulation.hpp"

#include <cmath>

#include "sim/schemes/registry.hpp"
#include "sim/schemes/substep_guard.hpp"
#include "sim/schemes/substeps.hpp"
#include "sim/timed_effects.hpp"

namespace drape {
namespace {

std::unique_ptr<StabilityGuard> make_asked_guard(const SimulationSettings& settings, const System& system) {
  auto guard = make_guard(settings, system);
  if (settings.integrator.allow_unstable) return guard;
  if (const auto problem = guard->problem()) throw UsageError(*problem);
  return guard;
}

State initial_state(const Cloth& cloth) {
  State state{.x = cloth.positions, .v = cloth.velocities, .step = 0};
  for (const int pin : cloth.pins) state.v.row(pin).setZero();
  return state;
}

}  // namespace

System make_system(const SimulationSettings& settings, std::vector<double>* effect_seconds) {
  return make_system(settings, settings.step, effect_seconds);
}

System make_system(const SimulationSettings& settings, double step, std::vector<double>* effect_seconds) {
  System system(settings.cloth, step);
  for (std::size_t i = 0; i < settings.effects.size(); ++i) {
    const SystemSizes before(system);
    settings.effects[i].install(system);
    if (effect_seconds != nullptr) time_additions(system, before, (*effect_seconds)[i]);
  }
  return system;
}

Simulation::Simulation(SimulationSettings settings, Timing timing)
    : settings_(std::move(settings)),
      effect_seconds_(timing == Timing::effects ? settings_.effects.size() : 0, 0.0),
      system_(make_system(settings_, measured())),
      phases_(pin_phases(settings_.cloth.pins, system_->pin_releases)),
      state_(initial_state(settings_.cloth)),
      forces_(*system_, state_),
      guard_(make_asked_guard(settings_, *system_)),
      scheme_(make_scheme()),
      springs_(system_->springs, settings_.cloth.vertex_count()),
      energy_([this] {
        const Energies now = energies();
        return now.kinetic + now.elastic;
      }) {
  guard_->begin(state_, energy_);
}

Simulation::~Simulation() = default;

void Simulation::enter_phase() {
  std::size_t now = phases_.size() - 1;
  while (phases_[now].first_step > state_.step) --now;
  if (now == phase_) return;
  scheme_.reset();  // it refers to the system
  phase_ = now;
  settings_.cloth.pins = phases_[now].pins;
  system_.emplace(make_system(settings_, measured()));
  scheme_ = make_scheme();
}

std::unique_ptr<Scheme> Simulation::make_scheme() {
  if (!settings_.accuracy) return method_type(settings_.integrator.method).make(settings_.integrator, *system_);
  const auto make = [this](double step) { return make_system(settings_, step, measured()); };
  const int fewest = SubstepGuard::fewest_halvings(settings_.step, guard_->longest_step());
  return std::make_unique<SubstepScheme>(settings_, fewest, make);
}

StepReport Simulation::step() {
  if (phases_.size() > 1) enter_phase();
  StepReport report = scheme_->advance(state_, forces_);
  for (const auto& filter : system_->filters) report.converged = report.converged && filter->converged();
  ++state_.step;
  // What is not finite makes the sum of its squares so, and any velocity that is not moves its vertex there.
  if (!std::isfinite(norm(state_.x))) throw diverged_by(std::nullopt);
  if (const auto growth = guard_->look(state_, forces_.push(), forces_.constant(), energy_)) throw diverged_by(growth);
  return report;
}

DivergedError Simulation::diverged_by(std::optional<double> growth) const {
  return diverged(state_, time(), growth, guard_->remedy());
}

void Simulation::restore(const State& state) {
  state_ = state;
  guard_->begin(state_, energy_);
}

void Simulation::restore(const Checkpoint& checkpoint) {
  state_ = checkpoint.state;
  if (checkpoint.books) guard_->go_on(*checkpoint.books);
}

Energies Simulation::energies() const {
  const Eigen::VectorXd& m = settings_.cloth.masses;
  ignored_.setZero(state_.x.rows(), 3);
  double elastic = springs_.add_value_gradient(state_.x, ignored_);
  for (const auto& energy : system_->energies) {
    if (energy->internal()) elastic += energy->add_gradient(state_.x, time(), ignored_);
  }
  per_vertex_ = state_.v.rowwise().squaredNorm();
  const double kinetic = 0.5 * m.dot(per_vertex_);
  per_vertex_.noalias() = state_.x * system_->gravity;
  return {.kinetic = kinetic, .gravity = -m.dot(per_vertex_), .elastic = elastic};
}

}  // namespace drape
