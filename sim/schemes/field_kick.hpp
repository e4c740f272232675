#pragma once

#include "sim/field_slope.hpp"

namespace drape {

/// Solver for the effect of velocity fields in an explicit step of h seconds. The fields act on single vertices, so
/// their velocities w require only a system of three equations per vertex,
///   w = v + h a(x, (v₀ + w)/2),
/// with velocities v₀ before the step and v after all other forces. This implicit midpoint rule has second order. A
/// force across the velocity keeps the speed and drag adds none. Beside springs it is stable up to the safe step
/// without the field. Backward Euler's rule, w = v + h a(x, w), is not, if a force across the velocity is strong.
class FieldKick {
 public:
  explicit FieldKick(const System& system);

  /// Replaces v by w.
  /// @param x, time position and time [m], [s]
  /// @param before v₀ [m/s]
  /// @return true if the iteration for w converged
  bool kick(const Vertices& x, double time, const Vertices& before, Vertices& v);
  /// Returns the force of the fields, n×3 [N].
  [[nodiscard]] const Vertices& force() const { return force_; }

 private:
  /// Computes a at the mean of the velocities `before` and w.
  void find_acceleration(const Vertices& before, const Vertices& w, double time);

  const System& system_;
  VelocityFields fields_;
  FieldSlopes slopes_;
  State state_;                                  // state for the evaluation of a
  Vertices w_, acceleration_, missing_, force_;  // [m/s], [m/s²], [m/s], [N]
};

}  // namespace drape
