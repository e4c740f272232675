#pragma once

// Example:
//   drape::Effects effects{drape::SelfCollision{.thickness = 0.02}};

#include "sim/effects/effect.hpp"
#include "sim/effects/response.hpp"

namespace drape {

/// Keeps the cloth from passing through itself, see SelfContact.
struct SelfCollision {
  static constexpr std::string_view name = "self_collision";
  static constexpr EffectCost cost{.evaluated = 0.6e-6, .solved = 4.0e-6};
  static constexpr bool touches = true;

  double thickness = 0.01;  ///< the distance that layers of the cloth keep [m]
  double repulsion = 20;    ///< the part of the missing distance by which they separate per second, at first [1/s]
  double friction = 0.3;    ///< Coulomb's coefficient between layers
  int iterations = 10;      ///< passes over the contacts of a step, and over its collisions before they become rigid
  std::optional<Response> response =
      {};  ///< impulses after the step, or solved for with it, the usual in an explicit one

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;
};

}  // namespace drape
