#pragma once

// Example:
//   drape::Effects effects{drape::Damping{.factor = 0.5}};

#include "drape/sim/effects/effect.hpp"

namespace drape {

/// Damping of all velocities at the same rate: v *= factor^h at the end of a step of h seconds.
struct Damping {
  static constexpr std::string_view name = "damping";

  double factor = 1;  ///< fraction of every velocity left after one second, above 0 and at most 1

  void describe(Keys& keys);
  void install(System& system) const;
};

}  // namespace drape
