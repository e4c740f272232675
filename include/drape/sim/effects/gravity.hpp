#pragma once

// Example:
//   drape::Effects effects{drape::Gravity{.acceleration = {0, 0, -1.62}}};

#include <Eigen/Core>

#include "drape/sim/effects/effect.hpp"

namespace drape {

/// Uniform acceleration whose potential energy is reported as gravity's.
struct Gravity {
  static constexpr std::string_view name = "gravity";

  Eigen::Vector3d acceleration{0, 0, -9.8};  ///< [m/s²]

  void describe(Keys& keys);
  void install(System& system) const;
};

}  // namespace drape
