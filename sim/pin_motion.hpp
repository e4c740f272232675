#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sim/keyframes.hpp"
#include "sim/mesh.hpp"

namespace drape {

class MeshAnchors;

/// Pins that move together. Pin k is at base + path(time), or with turns at middle + R(time)·(base − middle) +
/// path(time), where R turns about the fixed x axis, then y, then z. With anchors it is at its point on a mesh.
struct PinMotion {
  std::vector<int> vertices;                                        ///< their numbers
  Vertices base = {};                                               ///< start positions, one row each [m]
  Keyframes path = Keyframes({Keyframe{}}, Interpolation::linear);  ///< [m]
  std::optional<Keyframes> turn = {};                               ///< angles about the axes [degrees]
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< centre of the turns, in the coordinates of `base` [m]
  std::shared_ptr<const MeshAnchors> anchors = {};   ///< replace all of the above, one per pin

  /// Writes the pins' positions at a time [s] into their rows of x, n×3 [m].
  void place(double time, Vertices& x) const;

  /// Writes the mean velocity between two times [s] into the pins' rows of v, n×3 [m/s].
  void drive(double from, double to, Vertices& v) const;
  /// Writes the velocity at a time [s]; at a jump, the one before.
  void drive(double at, Vertices& v) const;

 private:
  /// Returns the position, or the velocity, of the k-th pin for motions with turns or anchors.
  [[nodiscard]] Eigen::Vector3d position(std::size_t k, double time) const;
  [[nodiscard]] Eigen::Vector3d velocity(std::size_t k, double time) const;
  [[nodiscard]] bool only_shifts() const { return !turn && !anchors; }
};

/// A release of pins.
struct PinRelease {
  std::int64_t step = 0;      ///< first step in which they move freely
  std::vector<int> vertices;  ///< their numbers
};

/// A range of steps, from the first on, with the same pins.
struct PinPhase {
  std::int64_t first_step = 0;
  std::vector<int> pins;
};

/// Returns the sets of pins over time, for pins (ascending) with releases. Sorted by step, from 0 on.
std::vector<PinPhase> pin_phases(const std::vector<int>& pins, const std::vector<PinRelease>& releases);

}  // namespace drape
