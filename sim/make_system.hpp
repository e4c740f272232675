#pragma once

#include <vector>

#include "sim/settings.hpp"
#include "sim/system.hpp"

namespace drape {

/// What acts on the cloth with the settings' effects. Refers to the settings and the threads, which must outlive it.
/// @param effect_seconds if given, one number for each effect, to which the time that it takes is added from then on
System make_system(const SimulationSettings& settings, std::vector<double>* effect_seconds = nullptr,
                   const Stop& stop = {}, const Threads& threads = one_thread());
/// The same in steps of another length [s].
System make_system(const SimulationSettings& settings, double step, std::vector<double>* effect_seconds = nullptr,
                   const Stop& stop = {}, const Threads& threads = one_thread());

}  // namespace drape
