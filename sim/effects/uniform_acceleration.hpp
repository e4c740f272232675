#pragma once

#include "sim/system.hpp"

namespace drape {

/// The same acceleration on every vertex, for as long as the scene lasts.
struct UniformAcceleration final : Force {
  Eigen::Vector3d acceleration;   ///< [m/s²]
  const Eigen::VectorXd& masses;  ///< [kg], of the system's cloth

  UniformAcceleration(const Eigen::Vector3d& a, const Eigen::VectorXd& m) : acceleration(a), masses(m) {}
  [[nodiscard]] bool constant() const override { return true; }
  void add(const State&, double, Vertices& force) const override {
    for (int axis = 0; axis < 3; ++axis) force.col(axis) += acceleration[axis] * masses;
  }
};

}  // namespace drape
