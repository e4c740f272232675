#include "sim/make_system.hpp"

#include "sim/timed_effects.hpp"

namespace drape {

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

}  // namespace drape
