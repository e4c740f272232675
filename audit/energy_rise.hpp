#pragma once

#include <span>

namespace drape::audit {

/// Largest rise of a motion's energy beyond the work done on it.
struct EnergyRise {
  double rise = 0;  ///< [J]; infinite for a non-finite energy
  int from = 0;     ///< state of least energy before the rise
  int to = 0;       ///< state at the end of the rise
};

/// Computes the largest rise over the running minimum: max over i < j of Eⱼ − Eᵢ − (W of the steps from i to j).
/// @param energies total energy of every state, including the first [J]
/// @param work     external work in each step, for example by moving obstacles and wind [J]; empty: none
/// @throws std::invalid_argument unless work is empty or one shorter than energies
EnergyRise largest_rise(std::span<const double> energies, std::span<const double> work = {});

}  // namespace drape::audit
