#pragma once

#include <vector>

#include "sim/system.hpp"

namespace drape {

/// The velocity fields of a system, which may be moved.
class VelocityFields {
 public:
  explicit VelocityFields(const System& system);

  /// sum = what they give the vertices in a state at a time [s], n×3, zero on pins [m/s²].
  void find(const State& state, double time, Vertices& sum) const;

 private:
  const Cloth& cloth_;
  std::vector<const Force*> fields_;
};

/// How the fields' acceleration of every vertex changes with its place and its velocity, by central differences: exact
/// but for rounding where a field is quadratic.
class FieldSlopes {
 public:
  explicit FieldSlopes(const System& system);

  /// Takes those of a state at a time [s].
  void find(const State& state, double time);

  [[nodiscard]] const std::vector<Eigen::Matrix3d>& of_place() const { return of_place_; }        ///< ∂a/∂x [1/s²]
  [[nodiscard]] const std::vector<Eigen::Matrix3d>& of_velocity() const { return of_velocity_; }  ///< ∂a/∂v [1/s]

 private:
  /// The derivatives by one of the two parts of a state.
  void differentiate(Vertices State::*part, double time, std::vector<Eigen::Matrix3d>& slopes);

  VelocityFields fields_;
  std::vector<Eigen::Matrix3d> of_place_, of_velocity_;
  // Scratch:
  State moved_;
  Eigen::VectorXd from_, way_;
  Vertices before_, after_;  // [m/s²]
};

}  // namespace drape
