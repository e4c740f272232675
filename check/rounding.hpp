#pragma once

#include <vector>

#include "sim/settings.hpp"
#include "sim/simulation.hpp"

namespace drape {

/// To what a golden's numbers are rounded: powers of two, so that what is rounded is exact, and stays when it is
/// rounded again. 0: not at all.
struct Quanta {
  double position = 0;  ///< of the states in which windows begin, and of pictures [m]
  double velocity = 0;  ///< of those states [m/s]
  double compared = 0;  ///< of what is only compared [m]

  bool operator==(const Quanta&) const = default;

  /// Of the motion's end, from which nothing goes on.
  [[nodiscard]] Quanta at_end() const { return {compared, velocity_factor * compared, compared}; }

  static constexpr double velocity_factor = 16;  ///< what is rounded leads as far in a sixteenth of a second [1/s]
};

/// The finest rounding of what is compared, where the bits are to be the same [m].
constexpr double least_quantum = 0x1p-34;

/// A position takes about 30 bits, and a velocity is rounded to what leads as far in a sixteenth of a second. Both are
/// exact where the rounding of a state could break a constraint that steps keep: of layers that touch each other, or of
/// springs that must not be longer. What is compared is rounded to a tenth of the tolerance, so that the rounding
/// decides nothing.
Quanta quanta_for(const SimulationSettings& settings, double motion_tolerance);

/// Every coordinate to the nearest multiple, but for some rows.
Vertices rounded(const Vertices& values, double quantum, const std::vector<int>& exact_rows = {});

/// Every number to the nearest multiple.
std::vector<double> rounded(std::vector<double> numbers, double quantum);

/// A state as a window begins with it. Pins stay where they are.
State rounded(const State& state, const std::vector<int>& pins, const Quanta& quanta);

}  // namespace drape
