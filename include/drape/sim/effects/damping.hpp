#pragma once

// Example:
//   drape::Effects effects{drape::Damping{.factor = 0.5}};

// Example:
//   drape::Effects effects{drape::InternalDamping{.relaxation_time = 0.01}};

#include "drape/sim/effects/effect.hpp"

namespace drape {

/// Damping of all velocities at the same rate: v *= factor^h at the end of a step of h seconds.
struct Damping {
  static constexpr std::string_view name = "damping";

  double factor = 1;  ///< fraction of every velocity left after one second, above 0 and at most 1

  void describe(Keys& keys);
  void install(System& system) const;
};

/// Internal friction of a Kelvin-Voigt material: a dashpot with the damping coefficient τ·k beside every spring of
/// stiffness k, and beside the bending energy. It acts on changes of shape alone and keeps both momenta.
struct InternalDamping {
  static constexpr std::string_view name = "internal_damping";
  static constexpr EffectCost cost{.evaluated = 10e-9, .solved = 0.5e-6};  ///< evaluated: for each stage of DampingKick

  double relaxation_time = 0.01;  ///< τ, above 0 [s]

  void describe(Keys& keys);
  void install(System& system) const;
};

}  // namespace drape
