#include "audit/energy_rise.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace drape::audit {

EnergyRise largest_rise(std::span<const double> energies, std::span<const double> work) {
  if (!work.empty() && work.size() + 1 != energies.size()) {
    throw std::invalid_argument(
        fmt::format("{} energies have {} steps, found work for {}", energies.size(), energies.size() - 1, work.size()));
  }
  EnergyRise largest;
  double least = std::numeric_limits<double>::infinity(), done = 0;
  int at_least = 0;
  for (std::size_t i = 0; i < energies.size(); ++i) {
    if (i > 0 && !work.empty()) done += work[i - 1];
    const double energy = energies[i] - done;
    const int state = static_cast<int>(i);
    if (!std::isfinite(energy)) return {std::numeric_limits<double>::infinity(), at_least, state};
    if (energy < least) least = energy, at_least = state;
    if (energy - least > largest.rise) largest = {energy - least, at_least, state};
  }
  return largest;
}

}  // namespace drape::audit
