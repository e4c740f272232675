#include "sim/system.hpp"

#include <algorithm>
#include <utility>

#include "sim/contact/impulse_contact.hpp"
#include "sim/contact/seams.hpp"
#include "sim/parallel/vectors.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/step_dissipation.hpp"
#include "sim/timed_effects.hpp"
#include "sim/velocity_field.hpp"

namespace drape {
namespace {

constexpr int most_turns = 4;  // of filters that undo each other's changes

}  // namespace

const SpringNetwork& System::network() const {
  if (!network_) network_ = std::make_unique<SpringNetwork>(springs, cloth.vertex_count(), threads);
  return *network_;
}

StiffnessBound System::stiffness_bound() const {
  StiffnessBound bound{.springs = springs, .vertices = Eigen::VectorXd::Zero(cloth.vertex_count())};
  for (const auto& energy : energies) energy->add_bound(bound);
  return bound;
}

std::vector<Collider> System::colliders_at(double at) const {
  std::vector<Collider> shapes;
  for (const auto& motion : colliders) shapes.push_back(motion->at(at));
  return shapes;
}

bool System::only_loses_energy() const {
  const bool rests = std::ranges::all_of(colliders, [](const auto& collider) { return collider->rests(); });
  if (!rests || !pin_motions.empty() || !fields.empty() || !cloth.seams.empty()) return false;
  const State at_rest{.x = cloth.positions, .v = Vertices::Zero(cloth.vertex_count(), 3), .step = 0};
  Vertices push = at_rest.v;
  for (const auto& force : forces) {
    if (force->of_contact()) continue;
    if (!force->constant()) return false;
    force->add(at_rest, 0, push);
  }
  return push.isApprox(cloth.masses * gravity.transpose());
}

void System::filter(State& state, Vertices& way) const {
  for (const auto& filter : filters) {
    filter->apply(state.x, time(state.step), step, way);
  }
  bool changed = filters.size() > 1;
  for (int turn = 0; changed && turn < most_turns; ++turn) {
    changed = false;
    for (const auto& filter : filters) changed = filter->adjust(state.x, time(state.step), step, way) || changed;
  }
  bool first = true;
  for (const auto& filter : filters) {
    filter->note(!changed);
    const Restraint* restraint = filter->restraint();
    if (restraint == nullptr) continue;
    if (std::exchange(first, false)) {
      state.restraint = *restraint;
    } else {  // of other cloths
      state.restraint.acceleration += restraint->acceleration;
      state.restraint.tensions += restraint->tensions;
    }
  }
}

void System::move(State& state, const Vertices* reached) const {
  if (filters.empty() && reached != nullptr) {
    copy(threads, *reached, state.x);
    return;
  }
  filter(state, state.v);
  add_multiple(threads, step, state.v, state.x);
  place_pins(time(state.step + 1), state.x);
  for (const auto& filter : filters) filter->finish(state.v);
}

void System::move(State& state, const Vertices& reached, Vertices& way) const {
  if (filters.empty()) {
    state.x = reached;
    return;
  }
  way = (reached - state.x) / step;
  state.v -= way;
  filter(state, way);
  state.v += way;
  add_multiple(threads, step, way, state.x);
  place_pins(time(state.step + 1), state.x);
  for (const auto& filter : filters) filter->finish(state.v);
}

namespace {

/// Adds the energy for velocity fields in implicit steps.
void add_drag(const IntegratorSettings& integrator, System& system) {
  if (system.fields.empty() || is_explicit(integrator.method)) return;
  const double solved = minimised_fraction(integrator.scheme) * system.step;
  auto drag = std::make_unique<FieldDrag>(system, solved, integrator.method == Method::liu13);
  system.drag = drag.get();
  system.energies.push_back(std::move(drag));
}

/// Adds the energies for dashpots in implicit steps.
void add_dissipations(const IntegratorSettings& integrator, System& system) {
  if (is_explicit(integrator.method)) return;
  const double shortest = minimised_fraction(integrator.scheme) * system.step;
  for (const auto& dashpots : system.dashpots) {
    auto dissipation = std::make_unique<StepDissipation>(dashpots, shortest, system.cloth.positions, system.threads);
    system.dissipations.push_back(dissipation.get());
    system.energies.push_back(std::move(dissipation));
  }
}

/// Adds everything that acts on the cloth.
void install_effects(const SimulationSettings& settings, std::vector<double>* effect_seconds, const Stop& stop,
                     System& system) {
  system.stop = stop;
  for (std::size_t i = 0; i < settings.effects.size(); ++i) {
    const SystemSizes before(system);
    settings.effects[i].install(system);
    for (std::size_t f = before.filters; f < system.filters.size(); ++f) system.filters[f]->set_stop(stop);
    if (effect_seconds != nullptr) time_additions(system, before, (*effect_seconds)[i]);
  }
  add_drag(settings.integrator, system);
  add_dissipations(settings.integrator, system);
  if (!system.cloth.seams.empty()) system.contacts.push_back(std::make_shared<SeamContacts>(system.cloth));
  if (system.contacts.empty()) return;
  // Explicit steps have no other contact. Implicit steps need this filter to keep their contacts after other filters.
  const bool explicitly = is_explicit(settings.integrator.method);
  if (!explicitly && system.filters.empty()) return;
  system.filters.push_back(std::make_unique<ImpulseContact>(system.contacts, system.cloth, system.gravity));
  system.filters.back()->set_stop(stop);
  if (explicitly) system.contacts.clear();
}

}  // namespace

System make_system(const SimulationSettings& settings, std::vector<double>* effect_seconds, const Stop& stop,
                   const Threads& threads) {
  const int substeps = settings.accuracy ? 1 : settings.integrator.substep_count();
  System system(settings.cloth, settings.step / substeps, threads);
  system.whole_step = settings.step;
  system.substeps = substeps;
  install_effects(settings, effect_seconds, stop, system);
  return system;
}

System make_system(const SimulationSettings& settings, double step, std::vector<double>* effect_seconds,
                   const Stop& stop, const Threads& threads) {
  System system(settings.cloth, step, threads);
  install_effects(settings, effect_seconds, stop, system);
  return system;
}

}  // namespace drape
