#pragma once

#include <span>

namespace drape::audit {

/// The largest rise of a motion's energy beyond the work done on it.
struct EnergyRise {
  double rise = 0;  ///< [J]; infinite where an energy is not finite
  int from = 0;     ///< the state of least energy before the rise
  int to = 0;       ///< the state at its top
};

/// Returns the largest rise over the running minimum: max over i < j of Eⱼ − Eᵢ − (W of the steps from i to j).
/// @param energies total energy of every state, the first included [J]
/// @param work     done from outside in each step, such as by moving obstacles and wind [J]; empty: none
/// @throws std::invalid_argument if work is neither empty nor one shorter than energies
EnergyRise largest_rise(std::span<const double> energies, std::span<const double> work = {});

}  // namespace drape::audit
