#pragma once

#include "sim/system.hpp"

namespace drape {

/// Uniform acceleration, constant in time.
struct UniformAcceleration final : Force {
  Eigen::Vector3d acceleration;   ///< [m/s²]
  const Eigen::VectorXd& masses;  ///< masses of the system's cloth [kg]

  UniformAcceleration(const Eigen::Vector3d& a, const Eigen::VectorXd& m) : acceleration(a), masses(m) {}
  [[nodiscard]] bool constant() const override { return true; }
  void add(const State&, double, Vertices& force) const override {
    for (int axis = 0; axis < 3; ++axis) force.col(axis) += acceleration[axis] * masses;
  }
};

}  // namespace drape
