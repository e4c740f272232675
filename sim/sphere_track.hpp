#pragma once

// Example:
//   drape::Sphere thrown;
//   thrown.track = drape::straight_track({.center = {-2, 0, 0}, .radius = 0.3}, {4, 0, 0});

#include <memory>

#include "sim/collider.hpp"
#include "sim/keyframes.hpp"

namespace drape {

/// Position of a sphere as a function of time.
class SphereTrack {
 public:
  virtual ~SphereTrack() = default;
  [[nodiscard]] virtual SphereShape at(double time) const = 0;
};

/// A circular orbit at constant speed.
struct Orbit {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< point on its axis [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< of any nonzero length; counterclockwise seen from its tip
  double period = 1;                                 ///< of a full turn, not 0; negative: clockwise [s]
};

/// Returns a straight track from `start`; the velocity in m/s is 0 for a fixed sphere.
std::shared_ptr<const SphereTrack> straight_track(const SphereShape& start, const Eigen::Vector3d& velocity);

/// Returns a circular track from `start` around an axis.
/// @throws std::invalid_argument if the axis or the period is 0
std::shared_ptr<const SphereTrack> circling_track(const SphereShape& start, const Orbit& orbit);

/// Returns a track with its centre at the keyframes.
std::shared_ptr<const SphereTrack> keyframed_track(double radius, Keyframes centers);

/// Returns another track with this radius [m].
std::shared_ptr<const SphereTrack> with_radius(std::shared_ptr<const SphereTrack> track, double radius);

}  // namespace drape
