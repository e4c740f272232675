#pragma once

// Example:
//   const drape::Keyframes up({{.time = 0, .value = {0, 0, 0}}, {.time = 2, .value = {0, 0, 1}}},
//                             drape::Interpolation::smooth);
//   const Eigen::Vector3d middle = up.at(1);  // (0, 0, 0.5)

#include <vector>

#include "core/keys.hpp"

namespace drape {

/// How a value gets from one keyframe to the next.
enum class Interpolation {
  linear,  ///< at a steady speed
  smooth   ///< without a jump of the speed
};

/// A value over time that goes through keyframes and has their very bits there.
///
/// Smooth is a cubic Hermite curve in each coordinate, whose slope at a keyframe is 0 at the ends and where the value
/// turns round, and otherwise the weighted harmonic mean of the slopes on both sides (Fritsch and Butland 1984): it
/// never leaves the range of two neighbouring keyframes, and rests between two equal ones.
class Keyframes {
 public:
  /// @param keyframes at least one, at increasing times
  /// @throws std::invalid_argument otherwise
  Keyframes(std::vector<Keyframe> keyframes, Interpolation interpolation);

  /// The value at a time [s]; before the first and after the last keyframe that of it.
  [[nodiscard]] Eigen::Vector3d at(double time) const;

  /// How fast it changes [1/s]; where that jumps, at a keyframe, as it does before.
  [[nodiscard]] Eigen::Vector3d velocity(double time) const;

 private:
  std::vector<Keyframe> keyframes_;
  std::vector<Eigen::Vector3d> slopes_;  // per second, at each keyframe; empty if linear
};

}  // namespace drape
