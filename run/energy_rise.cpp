#include "run/energy_rise.hpp"

#include <algorithm>

namespace drape {

void EnergyRise::begin(const Simulation& simulation) {
  watches_ = simulation.only_loses_energy();
  if (watches_ && !first_) note(simulation.energies());
}

void EnergyRise::after_step(const Simulation& simulation, const StepReport&, double) {
  if (watches_) note(simulation.energies());
}

void EnergyRise::replay(const StepRow& row, double, double) {
  if (row.step == 0) first_ = row.energies;
  note(row.energies);
}

void EnergyRise::note(const Energies& now) {
  if (!first_) first_ = now;
  available_ = std::max(available_, first_->total() - now.gravity);
  rise_ = std::max(rise_, now.total() - first_->total());
}

std::optional<EnergyRise::Rise> EnergyRise::rise() const {
  if (!watches_) return std::nullopt;
  return Rise{.energy = rise_, .of_available = available_ > 0 ? rise_ / available_ : 0};
}

}  // namespace drape
