#pragma once

#include "sim/field_slope.hpp"

namespace drape {

/// Solves for the velocities that velocity fields leave in an explicit step of h seconds. The fields are forces of
/// single vertices, so to solve for the velocities w that they leave takes no more than a system of three equations at
/// each,
///   w = v + h a(x, (v₀ + w)/2),
/// with v what all else makes of the velocities v₀ before: the implicit midpoint rule, of second order, by which a
/// force across the velocity keeps the speed and no drag gives any. Beside springs it is stable up to the step that is
/// safe without the field; backward Euler's rule, w = v + h a(x, w), is not where a force across the velocity is
/// strong.
class FieldKick {
 public:
  explicit FieldKick(const System& system);

  /// Makes v into w.
  /// @param x, time where and when [m], [s]
  /// @param before v₀ [m/s]
  /// @return whether w was found
  bool kick(const Vertices& x, double time, const Vertices& before, Vertices& v);
  /// The force that did it, n×3 [N].
  [[nodiscard]] const Vertices& force() const { return force_; }

 private:
  /// a at the velocities that w leads to.
  void find_acceleration(const Vertices& before, const Vertices& w, double time);

  const System& system_;
  VelocityFields fields_;
  FieldSlopes slopes_;
  State state_;                                  // where a is taken
  Vertices w_, acceleration_, missing_, force_;  // [m/s], [m/s²], [m/s], [N]
};

}  // namespace drape
