#pragma once

// Example:
//   const drape::Keyframes up({{.time = 0, .value = {0, 0, 0}}, {.time = 2, .value = {0, 0, 1}}},
//                             drape::Interpolation::smooth);
//   const Eigen::Vector3d middle = up.at(1);  // (0, 0, 0.5)

// Example:
//   drape::Sphere thrown;
//   thrown.track = drape::straight_track({.center = {-2, 0, 0}, .radius = 0.3}, {4, 0, 0});

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "drape/sim/mesh.hpp"
#include "drape/sim/state.hpp"

namespace drape {

/// A value at one time.
struct Keyframe {
  double time = 0;  ///< [s]
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
};

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

  /// Returns the value's rate of change [1/s]; at a jump, the rate just before.
  [[nodiscard]] Eigen::Vector3d velocity(double time) const;

 private:
  std::vector<Keyframe> keyframes_;
  std::vector<Eigen::Vector3d> slopes_;  // per second, at each keyframe; empty if linear
};

/// Position of a time between two samples.
struct Between {
  std::size_t before, after;  ///< indices of the two samples; equal at a sample, before the first and after the last
  double share;               ///< fraction of the way from `before` to `after`, 0 to 1; exactly 0 if equal
};

/// Returns the position of a time between samples.
/// @param times of the samples: at least one, ascending
inline Between between(const std::vector<double>& times, double time) {
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
  if (next == 0) return {0, 0, 0};
  if (next == times.size() || time == times[next - 1]) return {next - 1, next - 1, 0};
  return {next - 1, next, (time - times[next - 1]) / (times[next] - times[next - 1])};
}

/// Position of a sphere as a function of time.
class SphereTrack {
 public:
  virtual ~SphereTrack() = default;
  [[nodiscard]] virtual SphereShape at(double time) const = 0;
};

/// A circular orbit at constant speed.
struct Orbit {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< point on its axis [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< nonzero vector; counterclockwise seen from its tip
  double period = 1;                                 ///< time of a full turn, not 0; negative: clockwise [s]
};

/// Returns a straight track from `start`; the velocity in m/s is 0 for a fixed sphere.
std::shared_ptr<const SphereTrack> straight_track(const SphereShape& start, const Eigen::Vector3d& velocity);

/// Returns a circular track from `start` around an axis.
/// @throws std::invalid_argument if the axis or the period is 0
std::shared_ptr<const SphereTrack> circling_track(const SphereShape& start, const Orbit& orbit);

/// Returns a track whose centre follows keyframes.
std::shared_ptr<const SphereTrack> keyframed_track(double radius, Keyframes centers);

/// Returns a track with the same centre and this radius [m].
std::shared_ptr<const SphereTrack> with_radius(std::shared_ptr<const SphereTrack> track, double radius);

class MeshAnchors;

/// Pins that move together. Pin k is at base + path(time), or with turns at middle + R(time)·(base − middle) +
/// path(time), where R turns about the fixed x axis, then y, then z. With anchors it is at its point on a mesh.
struct PinMotion {
  std::vector<int> vertices;                                        ///< vertex numbers
  Vertices base = {};                                               ///< start positions, one row each [m]
  Keyframes path = Keyframes({Keyframe{}}, Interpolation::linear);  ///< [m]
  std::optional<Keyframes> turn = {};                               ///< angles about the axes [degrees]
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< centre of the turns, in the coordinates of `base` [m]
  std::shared_ptr<const MeshAnchors> anchors = {};   ///< replace base, path, turn and middle; one per pin

  /// Writes the pins' positions at a time [s] into their rows of x, n×3 [m].
  void place(double time, Vertices& x) const;

  /// Writes the mean velocity between two times [s] into the pins' rows of v, n×3 [m/s].
  void drive(double from, double to, Vertices& v) const;
  /// Writes the velocity at a time [s]; at a jump, the velocity before it.
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
  std::vector<int> vertices;  ///< vertex numbers
};

/// A range of steps, from the first on, with the same pins.
struct PinPhase {
  std::int64_t first_step = 0;
  std::vector<int> pins;
};

/// Returns the sets of pins over time, for pins (ascending) with releases. Sorted by step, from 0 on.
std::vector<PinPhase> pin_phases(const std::vector<int>& pins, const std::vector<PinRelease>& releases);

}  // namespace drape
