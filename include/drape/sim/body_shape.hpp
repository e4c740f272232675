#pragma once

// Example:
//   const drape::RigidMotion spinning(drape::straight_track({.center = {0, 0, 1}}, {0, 0, 0}),
//                                     Eigen::Matrix3d::Identity(), drape::Orbit{.center = {0, 0, 1}, .period = 2});
//   const Eigen::Vector3d corner = spinning.at(0.5).to_world({0.1, 0, 0});  // a quarter of a turn later: (0, 0.1, 1)

// Example:
//   drape::MeshMotion lift{.mesh = drape::make_grid(1, 1)};
//   lift.times = {0, 2};
//   lift.samples = {lift.mesh.positions, lift.mesh.positions.array() + 1};
//   drape::Vertices x;
//   lift.place(1, x);  // half-way

// Example:
//   drape::BodyShape pillar{.kind = drape::BodyShape::Kind::cylinder, .radius = 0.2, .height = 1.5};
//   drape::Body body{.center = Eigen::Vector3d(0, 0, 0.75), .shape = pillar};

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drape/sim/mesh.hpp"
#include "drape/sim/tracks.hpp"

namespace drape {

/// Returns the rotations about the fixed x, y and z axes, to be applied in this order.
std::array<Eigen::Matrix3d, 3> turns_about_axes(const Eigen::Vector3d& degrees);
/// Returns the product of the rotations about the three axes.
Eigen::Matrix3d turn_about_axes(const Eigen::Vector3d& degrees);

/// Position and orientation of a body: its coordinates are rotated, then translated.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< from the body's axes to the world's
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< of the body's origin [m]

  [[nodiscard]] Eigen::Vector3d to_world(const Eigen::Vector3d& p) const { return rotation * p + position; }
  [[nodiscard]] Eigen::Vector3d to_body(const Eigen::Vector3d& p) const {
    return rotation.transpose() * (p - position);
  }
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

/// A triangle mesh whose vertices move as a function of time. A fixed mesh has no samples.
struct MeshMotion {
  Mesh mesh;                           ///< triangles for all times, and positions of the first sample
  std::vector<double> times = {};      ///< times of the samples, ascending [s]
  std::vector<Vertices> samples = {};  ///< one per time: n×3 [m]

  /// Writes the positions at a time [s], n×3 [m]. Interpolates linearly between two samples, as USD does for points and
  /// matrices; constant before the first and after the last sample.
  void place(double time, Vertices& x) const;
};

class Keys;

/// A shape around the origin with its axis along z. All lengths are in m.
struct BodyShape {
  enum class Kind { cylinder, capsule, cone, plane, sphere };

  Kind kind = Kind::sphere;
  double radius = 0.5;  ///< for all kinds except the plane; for a cone at its base
  double height = 1;    ///< for a cylinder, a cone, and a capsule including its caps
  double top = 0;       ///< radius of a cone's upper end
  double width = 1;     ///< size of a plane along x
  double depth = 1;     ///< size of a plane along y
  int segments = 64;    ///< number of segments around the axis

  bool operator==(const BodyShape&) const = default;
};

/// The key of a body that gives it a shape of this kind; the target of a Key.
struct BodyShapeKey {
  BodyShape::Kind kind;
  std::optional<BodyShape>* shape;
};

/// Returns the names of the kinds, in the order of Kind: "cylinder" and so on.
const std::vector<std::string>& body_shape_names();

/// Returns the keys of the table for a shape of its kind.
/// @param shape must outlive the keys
Keys body_shape_keys(BodyShape& shape);

/// Returns the reason if the shape is invalid; otherwise nothing.
std::optional<std::string> body_shape_problem(const BodyShape& shape);

/// Returns a mesh of the shape, counterclockwise seen from outside. It is closed except for a plane, which faces up.
Mesh make_body_shape(const BodyShape& shape);

}  // namespace drape
