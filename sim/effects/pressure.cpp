#include "drape/sim/effects/pressure.hpp"

#include <fmt/format.h>
#include <cmath>
#include <stdexcept>

#include "core/keys.hpp"
#include "drape/sim/settings.hpp"
#include "sim/pressure/gas_energy.hpp"

namespace drape {
namespace {

// Smallest initial volume of an ideal gas, as a fraction of the surface's area to the power of 3/2.
constexpr double least_enclosed = 1e-4;
constexpr double most_pressure = 1e9;  // [Pa]

}  // namespace

void Pressure::describe(Keys& keys) {
  keys.add("pressure", &pressure, "Pa",
           "Pressure inside of every closed piece above that outside; for \"ideal\" at the start.")
      .at_least(0)
      .at_most(most_pressure)
      .must_be_given();
  keys.choice("gas", gas, {"constant", "ideal"},
              "\"constant\": the pressure stays. \"ideal\": (ambient + pressure) · volume stays, for each piece.");
  keys.add("ambient", &ambient, "Pa", "Pressure outside, for an ideal gas. With 0, pressure · volume stays.")
      .at_least(0)
      .at_most(most_pressure);
}

void Pressure::check(const SimulationSettings& settings, const ProblemSink& problem) const {
  if (gas == Gas::ideal && ambient + pressure == 0)
    problem("pressure", "expected some gas: 'ambient' and 'pressure' are 0");
  try {
    const std::vector<ClosedPiece> pieces = closed_pieces(settings.cloth);
    if (gas == Gas::constant) return;
    for (const ClosedPiece& piece : pieces) {
      const double volume = enclosed_volume(piece.triangles, settings.cloth.positions);
      const double area = surface_area(piece.triangles, settings.cloth.positions);
      if (volume > least_enclosed * std::pow(area, 1.5)) continue;
      problem("gas", fmt::format("\"ideal\" expects pieces that enclose gas at the start, but the one at vertex {} has "
                                 "{:.3g} m³ inside; expected more, or gas = \"constant\"",
                                 piece.triangles.front()[0], volume));
      return;
    }
  } catch (const std::invalid_argument& open) {
    problem("", open.what());
  }
}

void Pressure::install(System& system) const {
  const Cloth& cloth = system.cloth;
  const std::vector<ClosedPiece> pieces = closed_pieces(cloth);
  std::vector<GasLaw> laws;
  for (const ClosedPiece& piece : pieces) {
    const double most = GasEnergy::largest_volume(piece, cloth);
    const double volume = enclosed_volume(piece.triangles, cloth.positions);
    laws.push_back(gas == Gas::ideal ? GasLaw::ideal(pressure, ambient, volume, most)
                                     : GasLaw::constant(pressure, most));
  }
  system.energies.push_back(std::make_unique<GasEnergy>(cloth, pieces, laws));
}

}  // namespace drape
