#include "sim/rigid_motion.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>

namespace drape {

std::array<Eigen::Matrix3d, 3> turns_about_axes(const Eigen::Vector3d& degrees) {
  std::array<Eigen::Matrix3d, 3> about;
  for (int axis = 0; axis < 3; ++axis) {
    about[static_cast<std::size_t>(axis)] =
        Eigen::AngleAxisd(degrees[axis] * std::numbers::pi / 180, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
  }
  return about;
}

Eigen::Matrix3d turn_about_axes(const Eigen::Vector3d& degrees) {
  const auto about = turns_about_axes(degrees);
  return about[2] * about[1] * about[0];
}

RigidMotion::RigidMotion(std::shared_ptr<const SphereTrack> path, const Eigen::Matrix3d& turn,
                         std::optional<Orbit> orbit, std::optional<Keyframes> turns)
    : path_(std::move(path)), turn_(turn), orbit_(orbit), turns_(std::move(turns)) {
  if (orbit_) orbit_->axis.normalize();
}

Pose RigidMotion::at(double time) const {
  Pose pose{turn_, path_->at(time).center};
  if (turns_) pose.turn = turn_about_axes(turns_->at(time)) * turn_;
  if (!orbit_) return pose;
  // As for the path, a whole number of periods returns exactly to the start.
  const double turns = std::remainder(time / orbit_->period, 1.0);
  if (turns != 0) pose.turn = Eigen::AngleAxisd(2 * std::numbers::pi * turns, orbit_->axis) * pose.turn;
  return pose;
}

}  // namespace drape
