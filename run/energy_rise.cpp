#include "run/energy_rise.hpp"

#include <algorithm>

namespace drape {

void EnergyRise::begin(const Simulation& simulation) {
  watches_ = simulation.only_loses_energy();
  if (watches_) start(simulation.energies());
}

void EnergyRise::after_step(const Simulation& simulation, const StepReport&, double) {
  if (watches_) note(simulation.energies());
}

void EnergyRise::replay(const StepRow& row, double, double) {
  if (row.step == 0) {
    start(row.energies);
  } else {
    note(row.energies);
  }
}

void EnergyRise::start(const Energies& now) {
  first_ = now;
  available_ = now.kinetic + now.elastic;
  rise_ = 0;
}

void EnergyRise::note(const Energies& now) {
  available_ = std::max(available_, first_.kinetic + first_.elastic + first_.gravity - now.gravity);
  rise_ = std::max(rise_, now.total() - first_.total());
}

std::optional<EnergyRise::Rise> EnergyRise::rise() const {
  if (!watches_) return std::nullopt;
  return Rise{.energy = rise_, .of_available = available_ > 0 ? rise_ / available_ : 0};
}

}  // namespace drape
