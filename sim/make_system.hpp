#pragma once

#include <vector>

#include "sim/settings.hpp"
#include "sim/system.hpp"

namespace drape {

/// Returns the system of all that acts on the cloth with these settings. It refers to the settings and the threads,
/// which must outlive it.
/// @param effect_seconds if given, one number per effect, to which its computing time is added
System make_system(const SimulationSettings& settings, std::vector<double>* effect_seconds = nullptr,
                   const Stop& stop = {}, const Threads& threads = one_thread());
/// Returns the same system with another step length [s].
System make_system(const SimulationSettings& settings, double step, std::vector<double>* effect_seconds = nullptr,
                   const Stop& stop = {}, const Threads& threads = one_thread());

}  // namespace drape
