#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "check/report.hpp"
#include "drape/render/image.hpp"
#include "drape/sim/settings.hpp"
#include "drape/sim/simulation.hpp"

namespace drape {

/// The rounding units of a golden's numbers: powers of two, so that rounding is exact and repeatable. 0: no rounding.
struct RoundingUnits {
  double position = 0;  ///< quantum of states at the start of windows, and of pictures [m]
  double velocity = 0;  ///< velocity quantum of states at the start of windows [m/s]
  double compared = 0;  ///< quantum of data that are only compared [m]

  bool operator==(const RoundingUnits&) const = default;

  /// Returns the quanta for the final state, which is only compared.
  [[nodiscard]] RoundingUnits at_end() const { return {compared, velocity_factor * compared, compared}; }

  static constexpr double velocity_factor = 16;  ///< velocity quantum per position quantum [1/s]
};

/// Finest rounding of compared data, for bit-equal comparisons [m].
constexpr double least_quantum = 0x1p-34;

/// Returns the quanta of a motion. A position has about 30 bits; the velocity quantum moves a vertex by one position
/// quantum in 1/16 s. Both quanta are 0 if rounding could violate a constraint: contact of layers, or strain limits.
/// Compared data are rounded to a tenth of the tolerance, too fine to affect a verdict.
RoundingUnits quanta_for(const SimulationSettings& settings, double motion_tolerance);

/// Rounds every coordinate to the nearest multiple of `quantum`, except in `exact_rows`.
Vertices rounded(const Vertices& values, double quantum, const std::vector<int>& exact_rows = {});

/// Rounds every number to the nearest multiple of `quantum`.
std::vector<double> rounded(std::vector<double> numbers, double quantum);

/// Rounds the start state of a window; pins keep their positions.
State rounded(const State& state, const std::vector<int>& pins, const RoundingUnits& quanta);

/// Returns a description of this machine.
/// @param renderer see Renderer::description()
Machine this_machine(std::string renderer);

/// Converts a machine to JSON for a golden's manifest and report.json.
nlohmann::ordered_json to_json(const Machine& machine);

/// Returns the current time as "2026-01-31T12:00:00Z".
std::string utc_now();

/// Names the kind of difference between two pictures of one size: a shift, or a change in brightness, colours, edges or
/// a single region.
/// @returns empty if the pictures are equal, or no kind explains most of the difference
std::string classify_difference(const Image& expected, const Image& actual);

/// Lists differences between the recording machine and this one that may change pictures or bits: "with another
/// renderer (…; here …)". Empty if there are none.
std::string name_other_machine(const Machine& recorded, const Machine& here);

}  // namespace drape
