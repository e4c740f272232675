#pragma once

// Example:
//   drape::Effects effects{drape::Air{.velocity = {4, 0, 0}, .gusts = {.speed = 2}}};

#include <Eigen/Core>

#include "sim/effects/effect.hpp"
#include "sim/effects/gusts.hpp"

namespace drape {

/// Drag and lift of the air on every triangle, from a wind or from still air that slows the cloth down.
struct Air {
  static constexpr std::string_view name = "air";
  static constexpr EffectCost cost{.evaluated = 0.3e-6, .solved = 1.5e-6};

  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< wind velocity [m/s]
  double density = 1.2;                                ///< [kg/m³]
  double drag = 1.2;                                   ///< coefficient C_D of the force along the flow past a triangle
  double lift = 0.6;                                   ///< coefficient C_L of the force across the flow; requires drag
  GustValues gusts = {};

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;
};

}  // namespace drape
