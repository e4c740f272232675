#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "figures/diagram_files.hpp"
#include "sim/settings.hpp"

namespace drape {

/// The energy of a cloth over time, with a method and a step.
struct EnergyCurve {
  StepMethod method = Method::verlet;
  double step = 0;                    ///< h [s]
  std::vector<double> times = {};     ///< [s]
  std::vector<double> energies = {};  ///< K + E + gravity's above what it was at first, over the most that moved [1]
};

/// Eight seconds of the homework's cloth with springs of 180 N/m, which hangs from two corners and nothing damps: by
/// velocity Verlet, and by backward Euler and SDIRK2 with a long and a short step. Nothing is measured yet.
std::vector<EnergyCurve> energy_curves();

/// Steps of a curve.
std::int64_t step_count(const EnergyCurve& curve);

/// Measures a curve. One that was stopped is not to be used.
void measure_energy(EnergyCurve& curve, const std::stop_token& stop);

NamedChart energy_chart(const std::vector<EnergyCurve>& curves);

/// What is left of the energy at the end, in a sentence.
std::string describe_energies(const std::vector<EnergyCurve>& curves);

}  // namespace drape
