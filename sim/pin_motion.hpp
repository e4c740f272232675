#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sim/keyframes.hpp"
#include "sim/mesh.hpp"

namespace drape {

class MeshAnchors;

/// Pins that move together: pin k is at base + path(time); where they turn, at middle + R(time)·(base − middle) +
/// path(time), R being a turn about the fixed x axis, then y, then z; or where it holds on to a mesh.
struct PinMotion {
  std::vector<int> vertices;                                        ///< which they are
  Vertices base = {};                                               ///< a row for each of them [m]
  Keyframes path = Keyframes({Keyframe{}}, Interpolation::linear);  ///< [m]
  std::optional<Keyframes> turn = {};                               ///< about the axes [degrees]
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();                 ///< about which they turn, as `base` is [m]
  std::shared_ptr<const MeshAnchors> anchors = {};                  ///< of each of them, instead of all of that

  /// Writes where the pins are at a time [s] into their rows of x, n×3 [m].
  void place(double time, Vertices& x) const;

  /// Writes the velocity that leads from where they are at one time to where they are at another [s] into their rows
  /// of v, n×3 [m/s].
  void drive(double from, double to, Vertices& v) const;
  /// The same with the velocity that they have at a time, where it jumps that before.
  void drive(double at, Vertices& v) const;

 private:
  /// Where the k-th pin is, and its velocity, of those that do more than shift.
  [[nodiscard]] Eigen::Vector3d position(std::size_t k, double time) const;
  [[nodiscard]] Eigen::Vector3d velocity(std::size_t k, double time) const;
  [[nodiscard]] bool only_shifts() const { return !turn && !anchors; }
};

/// Pins that are let go.
struct PinRelease {
  std::int64_t step = 0;      ///< steps from this one on move them like every other vertex
  std::vector<int> vertices;  ///< which they are
};

/// The steps, from one on, in which the same vertices are pinned.
struct PinPhase {
  std::int64_t first_step = 0;
  std::vector<int> pins;
};

/// What is pinned when, of pins (ascending) that are released at some steps. By step, the first from 0 on.
std::vector<PinPhase> pin_phases(const std::vector<int>& pins, const std::vector<PinRelease>& releases);

}  // namespace drape
