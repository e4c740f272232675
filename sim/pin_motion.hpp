#pragma once

#include <cstdint>
#include <vector>

#include "sim/keyframes.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// Pins that move together, without turning: pin k is at base + path(time).
struct PinMotion {
  std::vector<int> vertices;  ///< which they are
  Vertices base;              ///< a row for each of them [m]
  Keyframes path;             ///< [m]

  /// Writes where the pins are at a time [s] into their rows of x, n×3 [m].
  void place(double time, Vertices& x) const;

  /// Writes the velocity that leads from where they are at one time to where they are at another [s] into their rows
  /// of v, n×3 [m/s].
  void drive(double from, double to, Vertices& v) const;
  /// The same with the velocity that they have at a time, where it jumps that before.
  void drive(double at, Vertices& v) const;
};

/// Pins that are let go.
struct PinRelease {
  std::int64_t step = 0;      ///< steps from this one on move them like every other vertex
  std::vector<int> vertices;  ///< which they are
};

/// The steps, from one on, in which the same vertices are pinned.
struct PinPhase {
  std::int64_t first_step = 0;
  std::vector<int> pins;
};

/// What is pinned when, of pins (ascending) that are released at some steps. By step, the first from 0 on.
std::vector<PinPhase> pin_phases(const std::vector<int>& pins, const std::vector<PinRelease>& releases);

}  // namespace drape
