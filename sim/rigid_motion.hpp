#pragma once

// Example:
//   const drape::RigidMotion spinning(drape::straight_track({.center = {0, 0, 1}}, {0, 0, 0}),
//                                     Eigen::Matrix3d::Identity(), drape::Orbit{.center = {0, 0, 1}, .period = 2});
//   const Eigen::Vector3d corner = spinning.at(0.5).out({0.1, 0, 0});  // a quarter of a turn later: (0, 0.1, 1)

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>

#include "sim/keyframes.hpp"
#include "sim/sphere_track.hpp"

namespace drape {

/// Returns the rotations about the fixed x, y and z axes, to be applied in this order.
std::array<Eigen::Matrix3d, 3> turns_about_axes(const Eigen::Vector3d& degrees);
/// Returns the product of all three.
Eigen::Matrix3d turn_about_axes(const Eigen::Vector3d& degrees);

/// Position and orientation of a body: its coordinates are rotated, then translated.
struct Pose {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< rotation
  Eigen::Vector3d place = Eigen::Vector3d::Zero();     ///< position of the body's origin [m]

  /// Converts from the body's coordinates to the world's; in() converts back.
  [[nodiscard]] Eigen::Vector3d out(const Eigen::Vector3d& p) const { return turn * p + place; }
  [[nodiscard]] Eigen::Vector3d in(const Eigen::Vector3d& p) const { return turn.transpose() * (p - place); }
};

/// Rigid motion of a body as a function of time.
class RigidMotion {
 public:
  /// @param path  of the body's origin; its radius is ignored
  /// @param turn  orientation at 0 s
  /// @param orbit if given, the body turns with it and keeps facing its axis
  /// @param turns if given, rotations about axes through its origin, after `turn` [degrees]
  RigidMotion(std::shared_ptr<const SphereTrack> path, const Eigen::Matrix3d& turn,
              std::optional<Orbit> orbit = std::nullopt, std::optional<Keyframes> turns = std::nullopt);

  [[nodiscard]] Pose at(double time) const;

 private:
  std::shared_ptr<const SphereTrack> path_;
  Eigen::Matrix3d turn_;
  std::optional<Orbit> orbit_;
  std::optional<Keyframes> turns_;
};

}  // namespace drape
