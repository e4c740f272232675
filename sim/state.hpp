#pragma once

// Example:
//   const drape::State a{.x = drape::Vertices::Zero(4, 3), .v = drape::Vertices::Zero(4, 3)};
//   drape::State b = a;
//   b.x(3, 2) = 1e-300;
//   const bool differ = drape::hash_of(a) != drape::hash_of(b);  // true

#include <cstdint>

#include "sim/mesh.hpp"

namespace drape {

/// Effect of strain limits on a cloth in a step; empty without limits.
struct Restraint {
  Vertices acceleration = {};     ///< acceleration removed from the vertices, n×3 [m/s²]
  Eigen::VectorXd tensions = {};  ///< tension added to the cloth's springs; negative if pushing [N]
};

/// Position and motion of a cloth after `step` steps. Time is step·h, never accumulated.
struct State {
  Vertices x = {};  ///< n×3 [m]
  Vertices v = {};  ///< n×3 [m/s]
  std::int64_t step = 0;
  /// From the last step, as an initial guess for the next: for the implicit solve, and for the limits. It influences
  /// the rest of the motion only within the tolerances of both.
  Restraint restraint = {};
};

/// Returns a hash of all bits of a state. Two runs with the same hash agree from there on. Not cryptographic.
std::uint64_t hash_of(const State& state);

/// Energy history of a simulation, to detect a blow-up.
struct EnergyMemory {
  double explained = 0;  ///< [J]
  Vertices looked_at;    ///< positions at the last check, n×3 [m]
  double work = 0;       ///< since the last check [J]
};

}  // namespace drape
