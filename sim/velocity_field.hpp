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

  /// Returns ∂a/∂x of each vertex [1/s²].
  [[nodiscard]] const std::vector<Eigen::Matrix3d>& by_position() const { return by_position_; }
  /// Returns ∂a/∂v of each vertex [1/s].
  [[nodiscard]] const std::vector<Eigen::Matrix3d>& by_velocity() const { return by_velocity_; }

 private:
  /// Computes the derivatives by one part of a state.
  void differentiate(Vertices State::*part, double time, std::vector<Eigen::Matrix3d>& slopes);

  VelocityFields fields_;
  std::vector<Eigen::Matrix3d> by_position_, by_velocity_;
  // Scratch:
  State moved_;
  Eigen::VectorXd from_, way_;
  Vertices before_, after_;  // [m/s²]
};

/// Energy of velocity fields in an implicit step of τ seconds: the linear part of their effect that has a dissipative
/// potential. With v = (x − x₀)/τ a vertex's acceleration changes by G = ∂a/∂v/τ + ∂a/∂x per metre. The symmetric part
/// of −G without its negative eigenvalues acts like a spring to the start of the step, E = ½ Σ m (x − x₀)ᵀQ(x − x₀). As
/// part of g it is in every solver's Hessian, so stiff drag needs no iteration. FieldSolve corrects for the difference
/// between a and this energy.
///
/// The antisymmetric part rotates velocities by α = τ²‖G − Gᵀ‖/2 per step. Iterating for it multiplies the errors of a
/// free vertex by iα. Adding α²/(1 + α)/τ² to Q in every direction turns this factor into (s + iα)/(1 + s) with s =
/// α²/(1 + α). That is below 1 for any α and leaves small ones unchanged.
///
/// Outside of a step Q is zero.
class FieldDrag final : public Energy {
 public:
  /// @param duration τ [s]
  /// @param bounded  true to keep Q below its initial value, for solvers that rely on add_bound()
  FieldDrag(const System& system, double duration, bool bounded);

  /// Evaluates Q at a state and a time [s] for a step from `start`, n×3 [m]. Returns true if it has changed.
  bool begin(const State& state, double time, const Vertices& start);
  /// Ends the step.
  void end() { q_.setZero(); }
  /// Adds τ² (I + τ² Q)⁻¹ a to x: the move of free vertices in the step by an acceleration a, n×3 [m/s²].
  void add_way(const Vertices& acceleration, Vertices& x) const;
  /// Adds Q (x − x₀) to the acceleration, n×3 [m/s²].
  void add_pull(const Vertices& x, Vertices& acceleration) const;

  double add_gradient(const Vertices& x, double time, Vertices& gradient) const override;
  void add_bound(StiffnessBound& bound) const override { bound.vertices += bound_; }
  [[nodiscard]] std::unique_ptr<EnergyHessian> make_hessian() const override;

 private:
  class Hessian;
  using Blocks = Eigen::Matrix<double, Eigen::Dynamic, 6>;

  /// Returns Q of one vertex [1/s²].
  [[nodiscard]] Eigen::Matrix3d drag(std::size_t vertex, double most) const;

  const Eigen::VectorXd& masses_;
  double duration_;
  bool bounded_;
  FieldSlopes slopes_;
  Vertices start_;         // x₀
  Blocks q_, before_;      // Q as in HessianBlocks, and scratch [1/s²]
  Eigen::VectorXd bound_;  // m Q at the start of the motion [N/m]
};

}  // namespace drape
