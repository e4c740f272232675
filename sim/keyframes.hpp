#pragma once

// Example:
//   const drape::Keyframes up({{.time = 0, .value = {0, 0, 0}}, {.time = 2, .value = {0, 0, 1}}},
//                             drape::Interpolation::smooth);
//   const Eigen::Vector3d middle = up.at(1);  // (0, 0, 0.5)

#include <vector>

#include "core/keyframe.hpp"

namespace drape {

/// How a value moves from one keyframe to the next.
enum class Interpolation {
  linear,  ///< at a steady speed
  smooth   ///< with a continuous speed
};

/// Keyframes from 0 s on: with one of this value then, unless there is one.
std::vector<Keyframe> starting_at(std::vector<Keyframe> keyframes, const Eigen::Vector3d& value);

/// A value over time that passes through keyframes, and equals them to the bit there.
///
/// Smooth is a cubic Hermite curve in each coordinate, whose slope at a keyframe is 0 at the ends and where the value
/// turns round, and otherwise the weighted harmonic mean of the slopes on both sides (Fritsch and Butland 1984): it
/// never leaves the range of two neighbouring keyframes, and rests between two equal ones.
class Keyframes {
 public:
  /// @param keyframes at least one, at increasing times
  /// @throws std::invalid_argument otherwise
  Keyframes(std::vector<Keyframe> keyframes, Interpolation interpolation);

  /// The value at a time [s]; before the first keyframe and after the last it is constant.
  [[nodiscard]] Eigen::Vector3d at(double time) const;

  /// Its rate of change [1/s]; where that jumps, at a keyframe, the rate just before it.
  [[nodiscard]] Eigen::Vector3d velocity(double time) const;

 private:
  std::vector<Keyframe> keyframes_;
  std::vector<Eigen::Vector3d> slopes_;  // per second, at each keyframe; empty if linear
};

}  // namespace drape
