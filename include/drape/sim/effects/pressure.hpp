#pragma once

// Example:
//   drape::Effects effects{drape::Pressure{.pressure = 500}};
//   effects.add(drape::Pressure{.pressure = 2000, .gas = drape::Gas::ideal});

#include "drape/sim/effects/effect.hpp"

namespace drape {

/// Relation between the pressure of an enclosed gas and its volume.
enum class Gas {
  constant,  ///< the pressure stays the same, as if a pump held it
  ideal,     ///< pressure times volume stays the same: a fixed amount of gas at constant temperature
};

/// Gas inside of every closed piece of the cloth, which pushes on its surface from within.
struct Pressure {
  static constexpr std::string_view name = "pressure";
  static constexpr EffectCost cost{.evaluated = 11e-9, .solved = 0.1e-6};

  /// Excess of the inside over the outside pressure [Pa], at least 0; for an ideal gas, its initial value.
  double pressure = 0;
  Gas gas = Gas::constant;
  /// Pressure outside, for an ideal gas [Pa], at least 0.
  double ambient = 101325;

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;
};

}  // namespace drape
