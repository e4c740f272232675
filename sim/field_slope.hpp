#pragma once

#include <vector>

#include "sim/system.hpp"

namespace drape {

/// Velocity fields of a system, which may be moved in memory.
class VelocityFields {
 public:
  explicit VelocityFields(const System& system);

  /// Sets sum = the fields' acceleration of the vertices at a state and a time [s], n×3, zero on pins [m/s²].
  void find(const State& state, double time, Vertices& sum) const;

 private:
  const Cloth& cloth_;
  std::vector<const Force*> fields_;
};

/// Derivatives of the fields' acceleration by a vertex's position and velocity, by central differences. They are exact
/// up to rounding for quadratic fields.
class FieldSlopes {
 public:
  explicit FieldSlopes(const System& system);

  /// Computes the derivatives at a state and a time [s].
  void find(const State& state, double time);

  [[nodiscard]] const std::vector<Eigen::Matrix3d>& position_forces() const {
    return position_forces_;
  }  ///< ∂a/∂x [1/s²]
  [[nodiscard]] const std::vector<Eigen::Matrix3d>& velocity_forces() const {
    return velocity_forces_;
  }  ///< ∂a/∂v [1/s]

 private:
  /// Computes the derivatives by one part of a state.
  void differentiate(Vertices State::*part, double time, std::vector<Eigen::Matrix3d>& slopes);

  VelocityFields fields_;
  std::vector<Eigen::Matrix3d> position_forces_, velocity_forces_;
  // Scratch:
  State moved_;
  Eigen::VectorXd from_, way_;
  Vertices before_, after_;  // [m/s²]
};

}  // namespace drape
