#pragma once

// Example:
//   drape::Effects effects{drape::SelfCollision{.thickness = 0.02}};

#include <array>
#include <string>
#include <vector>

#include "drape/sim/effects/effect.hpp"

namespace drape {

/// Friction between two cloths.
struct ClothFriction {
  std::array<std::string, 2> cloths;  ///< names; two equal ones: a cloth with itself
  double friction = 0;                ///< Coulomb's coefficient
};

/// Contact of the cloth with itself and of several cloths with each other, so that nothing passes through, see
/// SelfContacts.
struct SelfCollision {
  static constexpr std::string_view name = "self_collision";
  static constexpr EffectCost cost{.evaluated = 0.6e-6, .solved = 4.0e-6};
  static constexpr bool touches = true;

  double thickness = 0.01;  ///< distance between layers of the cloth [m]
  double friction = 0.3;    ///< Coulomb's coefficient between layers

  bool allow_overlap = false;               ///< true: the cloth may begin across itself, and is separated step by step
  std::vector<ClothFriction> contact = {};  ///< instead of `friction`, for these pairs of cloths

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;
};

}  // namespace drape
