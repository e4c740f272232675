#pragma once

// Example:
//   drape::Effects effects{drape::Air{.velocity = {4, 0, 0}, .gusts = {.speed = 2}}};

#include <Eigen/Core>

#include "sim/effects/effect.hpp"
#include "sim/effects/gusts.hpp"

namespace drape {

/// The air's drag and lift on every triangle: a wind, or air that is still and slows the cloth down.
struct Air {
  static constexpr std::string_view name = "air";
  static constexpr EffectCost cost{.evaluated = 0.3e-6, .solved = 1.5e-6};

  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of the wind [m/s]
  double density = 1.2;                                ///< [kg/m³]
  double drag = 1.2;                                   ///< C_D, of the force along the wind that passes a triangle
  double lift = 0.6;                                   ///< C_L, of the force across it; there is none without drag
  GustValues gusts = {};

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;
};

}  // namespace drape
