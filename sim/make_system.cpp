#include "sim/make_system.hpp"

#include "sim/timed_effects.hpp"

namespace drape {

System make_system(const SimulationSettings& settings, std::vector<double>* effect_seconds, const Stop& stop,
                   const Threads& threads) {
  return make_system(settings, settings.step, effect_seconds, stop, threads);
}

System make_system(const SimulationSettings& settings, double step, std::vector<double>* effect_seconds,
                   const Stop& stop, const Threads& threads) {
  System system(settings.cloth, step, threads);
  system.stop = stop;
  for (std::size_t i = 0; i < settings.effects.size(); ++i) {
    const SystemSizes before(system);
    settings.effects[i].install(system);
    for (std::size_t f = before.filters; f < system.filters.size(); ++f) system.filters[f]->heed(stop);
    if (effect_seconds != nullptr) time_additions(system, before, (*effect_seconds)[i]);
  }
  return system;
}

}  // namespace drape
