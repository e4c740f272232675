#pragma once

// Example:
//   drape::Effects effects{drape::Wind{.acceleration = {0, 3, 0}}};

#include <Eigen/Core>

#include "sim/effects/effect.hpp"

namespace drape {

/// Uniform acceleration as in the homework: a second gravity. For the force of moving air see Air.
struct Wind {
  static constexpr std::string_view name = "wind";
  static constexpr EffectCost cost{.evaluated = 10e-9, .solved = 10e-9};

  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< [m/s²]

  void describe(Keys& keys);
  void install(System& system) const;
};

}  // namespace drape
