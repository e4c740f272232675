#pragma once

// Example:
//   drape::Sphere thrown;
//   thrown.track = drape::straight_track({.center = {-2, 0, 0}, .radius = 0.3}, {4, 0, 0});

#include <memory>

#include "sim/collider.hpp"
#include "sim/keyframes.hpp"

namespace drape {

/// Where a sphere is, as a function of time alone.
class SphereTrack {
 public:
  virtual ~SphereTrack() = default;
  [[nodiscard]] virtual SphereShape at(double time) const = 0;
};

/// A circle, followed at constant speed.
struct Orbit {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< a point of its axis [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< of any length but 0; counterclockwise seen from its tip
  double period = 1;                                 ///< of a whole turn, not 0; negative: the other way round [s]
};

/// From `start` along a straight line; velocity in m/s, 0 for a sphere that stays where it is.
std::shared_ptr<const SphereTrack> straight_track(const SphereShape& start, const Eigen::Vector3d& velocity);

/// From `start` around an axis.
/// @throws std::invalid_argument if the axis is 0 or the period is 0
std::shared_ptr<const SphereTrack> circling_track(const SphereShape& start, const Orbit& orbit);

/// With its centre at the keyframes.
std::shared_ptr<const SphereTrack> keyframed_track(double radius, Keyframes centers);

/// Another track with a sphere of this radius [m].
std::shared_ptr<const SphereTrack> with_radius(std::shared_ptr<const SphereTrack> track, double radius);

}  // namespace drape
