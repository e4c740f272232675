#pragma once

// Example:
//   const drape::State a{.x = drape::Vertices::Zero(4, 3), .v = drape::Vertices::Zero(4, 3)};
//   drape::State b = a;
//   b.x(3, 2) = 1e-300;
//   const bool differ = drape::hash_of(a) != drape::hash_of(b);  // true

#include <cstdint>

#include "sim/mesh.hpp"

namespace drape {

/// Where the cloth is and how it moves after `step` steps. Time is step·h, never accumulated.
struct State {
  Vertices x = {};  ///< n×3 [m]
  Vertices v = {};  ///< n×3 [m/s]
  std::int64_t step = 0;
  /// By which acceleration limits of strain held the vertices back in the last step, n×3 [m/s²]; empty where none did.
  /// They will again: what solves for where the cloth goes begins there. Not where it is, but a part of the rest of its
  /// motion, to the solver's tolerance.
  Vertices held = {};
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
