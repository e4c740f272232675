#pragma once

// Example:
//   drape::Effects effects{drape::Damping{.factor = 0.5}};

#include "sim/effects/effect.hpp"

namespace drape {

/// Reduces every velocity by the same fraction in the same time: v *= factor^h at the end of a step of h seconds.
struct Damping {
  static constexpr std::string_view name = "damping";

  double factor = 1;  ///< what is left of every velocity after one second, above 0 and at most 1

  void describe(Keys& keys);
  void install(System& system) const;
};

}  // namespace drape
