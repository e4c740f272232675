#pragma once

// Example:
//   drape::Effects effects{drape::SelfCollision{.thickness = 0.02}};

#include "sim/effects/effect.hpp"

namespace drape {

/// Keeps the cloth from going through itself, see SelfContact.
struct SelfCollision {
  static constexpr std::string_view name = "self_collision";

  double thickness = 0.01;  ///< that layers of the cloth keep between them [m]
  double repulsion = 20;    ///< which part of what is missing to that they part by in a second, at first [1/s]
  double friction = 0.3;    ///< Coulomb's coefficient between layers
  int iterations = 10;      ///< passes over the contacts of a step, and over its collisions before they become rigid

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;
};

}  // namespace drape
