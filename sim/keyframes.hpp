#pragma once

// Example:
//   const drape::Keyframes up({{.time = 0, .value = {0, 0, 0}}, {.time = 2, .value = {0, 0, 1}}},
//                             drape::Interpolation::smooth);
//   const Eigen::Vector3d middle = up.at(1);  // (0, 0, 0.5)

#include <vector>

#include "core/keyframe.hpp"

namespace drape {

/// Interpolation of a value between keyframes.
enum class Interpolation {
  linear,  ///< at constant speed
  smooth   ///< at continuous speed
};

/// Returns keyframes from 0 s on; inserts one at 0 s with this value if there is none.
std::vector<Keyframe> starting_at(std::vector<Keyframe> keyframes, const Eigen::Vector3d& value);

/// A value over time that passes exactly through keyframes.
///
/// The smooth form is a cubic Hermite curve per coordinate. Its slope is 0 at the ends and at extrema. At other
/// keyframes it is the weighted harmonic mean of the slopes on both sides (Fritsch and Butland 1984). So it never
/// leaves the range of two neighbouring keyframes, and rests between two equal ones.
class Keyframes {
 public:
  /// @param keyframes at least one, at ascending times
  /// @throws std::invalid_argument otherwise
  Keyframes(std::vector<Keyframe> keyframes, Interpolation interpolation);

  /// Returns the value at a time [s]; constant before the first keyframe and after the last.
  [[nodiscard]] Eigen::Vector3d at(double time) const;

  /// Returns its rate of change [1/s]; at a jump, the rate just before.
  [[nodiscard]] Eigen::Vector3d velocity(double time) const;

 private:
  std::vector<Keyframe> keyframes_;
  std::vector<Eigen::Vector3d> slopes_;  // per second, at each keyframe; empty if linear
};

}  // namespace drape
