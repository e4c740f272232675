#pragma once

// Example:
//   const drape::State a{.x = drape::Vertices::Zero(4, 3), .v = drape::Vertices::Zero(4, 3)};
//   drape::State b = a;
//   b.x(3, 2) = 1e-300;
//   const bool differ = drape::hash_of(a) != drape::hash_of(b);  // true

#include <cstdint>

#include "sim/mesh.hpp"

namespace drape {

/// How limits of strain held a cloth back in a step; both empty where it has none.
struct Restraint {
  Vertices acceleration = {};     ///< that they took from the vertices, n×3 [m/s²]
  Eigen::VectorXd tensions = {};  ///< by which they pulled the cloth's springs together, negative where apart [N]
};

/// Where the cloth is and how it moves after `step` steps. Time is step·h, never accumulated.
struct State {
  Vertices x = {};  ///< n×3 [m]
  Vertices v = {};  ///< n×3 [m/s]
  std::int64_t step = 0;
  /// In the last step. It will be about the same in the next: what solves for where the cloth goes begins where it
  /// would go without it, and the limits begin with it. Not where the cloth is, but a part of the rest of its motion,
  /// to the tolerances of both.
  Restraint restraint = {};
};

/// A hash of a state to the bit: of all that it holds. Two runs with the same hash agree from
/// there on. It tells states apart, but is not cryptographic.
std::uint64_t hash_of(const State& state);

/// What a simulation remembers of its energy, to recognise a blow-up.
struct EnergyMemory {
  double explained = 0;  ///< [J]
  Vertices looked_at;    ///< where the cloth was when it last looked, n×3 [m]
  double work = 0;       ///< since then [J]
};

}  // namespace drape
