#pragma once

// Example:
//   drape::Effects effects{drape::Ground{.height = -1, .friction = 0.3}};

#include <Eigen/Core>

#include "drape/sim/effects/effect.hpp"

namespace drape {

/// A plane that keeps the cloth out of the half-space below it.
struct Ground {
  static constexpr std::string_view name = "ground";
  static constexpr EffectCost cost{.evaluated = 20e-9, .solved = 0.3e-6};
  static constexpr bool touches = true;
  static constexpr bool repeatable = true;

  double height = 0;                                  ///< distance of the plane from the origin along the normal [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward direction, a nonzero vector of any length
  double thickness = 0.02;                            ///< distance that the cloth keeps from the plane [m]

  double friction = 0.5;   ///< Coulomb's coefficient
  double restitution = 0;  ///< coefficient for impacts, 0 to 1

  bool allow_overlap = false;  ///< true: the cloth may begin inside, and is separated step by step

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;
};

}  // namespace drape
