#include "sim/make_system.hpp"

#include <utility>

#include "sim/contact/impulse_contact.hpp"
#include "sim/field_drag.hpp"
#include "sim/schemes/sdirk2.hpp"
#include "sim/timed_effects.hpp"

namespace drape {
namespace {

/// Adds the energy for velocity fields in implicit steps.
void add_drag(const IntegratorSettings& integrator, System& system) {
  if (system.fields.empty() || is_explicit(integrator.method)) return;
  const double solved = integrator.scheme == TimeScheme::sdirk2 ? Sdirk2::gamma * system.step : system.step;
  auto drag = std::make_unique<FieldDrag>(system, solved, integrator.method == Method::liu13);
  system.drag = drag.get();
  system.energies.push_back(std::move(drag));
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
