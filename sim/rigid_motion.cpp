#include "sim/rigid_motion.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>

namespace drape {

RigidMotion::RigidMotion(std::shared_ptr<const SphereTrack> path, const Eigen::Matrix3d& turn,
                         std::optional<Orbit> orbit)
    : path_(std::move(path)), turn_(turn), orbit_(orbit) {
  if (orbit_) orbit_->axis.normalize();
}

Pose RigidMotion::at(double time) const {
  Pose pose{turn_, path_->at(time).center};
  if (!orbit_) return pose;
  // As the path does: a whole number of periods leads back to the very start.
  const double turns = std::remainder(time / orbit_->period, 1.0);
  if (turns != 0) pose.turn = Eigen::AngleAxisd(2 * std::numbers::pi * turns, orbit_->axis) * turn_;
  return pose;
}

}  // namespace drape
