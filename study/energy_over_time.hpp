#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "drape/sim/settings.hpp"
#include "reports/diagram_files.hpp"

namespace drape {

/// Energy of a cloth over time, for a method and a step length.
struct EnergyCurve {
  StepMethod method = Method::verlet;
  double step = 0;                    ///< step length h [s]
  std::vector<double> times = {};     ///< [s]
  std::vector<double> energies = {};  ///< change of K + E + gravity's, over the largest drop of gravity's [1]
};

/// Returns the curves to measure: eight seconds of the homework's cloth, undamped, with springs of 180 N/m, hung from
/// two corners. Methods: velocity Verlet, and backward Euler and SDIRK2 with a long and a short step.
std::vector<EnergyCurve> energy_curves();

/// Returns the number of steps of a curve.
std::int64_t step_count(const EnergyCurve& curve);

/// Measures a curve. A stopped curve is invalid.
void measure_energy(EnergyCurve& curve, const std::stop_token& stop);

NamedChart energy_chart(const std::vector<EnergyCurve>& curves);

/// Returns a sentence about the energy left at the end.
std::string describe_energies(const std::vector<EnergyCurve>& curves);

}  // namespace drape
