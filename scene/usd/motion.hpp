#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "drape/sim/mesh.hpp"
#include "drape/sim/tracks.hpp"
#include "scene/mesh/source.hpp"
#include "scene/usd/stage.hpp"

namespace drape {

/// A transform over time, with the bounding sphere of the transformed object.
struct TransformTrack {
  std::vector<double> times;                ///< sample times, increasing [s]; at least one
  std::vector<Eigen::Affine3d> transforms;  ///< one per time: from object to world coordinates [m]

  /// Bounding sphere in object coordinates and units, around the middle of the bounding box of the points. For an
  /// icosphere or a UV sphere that is the sphere itself; an object without a shape has radius 0.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;
  std::vector<double> radius_times = {};  ///< sample times of a Sphere's radius, increasing [s]; empty: constant
  std::vector<double> radii = {};         ///< one per time

  /// Returns the radius in object units at a time [s], constant outside the samples.
  [[nodiscard]] double radius_at(double time) const;

  /// Returns the transform at a time [s], constant outside the samples. In between each matrix element is interpolated
  /// linearly as in USD, so rotations need dense samples.
  [[nodiscard]] Eigen::Affine3d at(double time) const;

  /// Returns the bounding sphere at a time [s], in the world [m]. If the transform stretches it, the radius is the
  /// longest half-axis.
  [[nodiscard]] SphereShape sphere_at(double time) const;
};

/// Reads the motion of a prim by its transform and those of its ancestors. A static prim has one sample.
/// @throws UsageError "file:line:column: message"
TransformTrack read_usd_track(const UsdStage& stage, const UsdPath& path);

/// Reads the motion of the first moving Mesh or Sphere of an ASCII USD file. If none moves: the first Mesh or Sphere,
/// with one sample. If there is none: the first moving prim of any type. The time of a sample is (time code −
/// startTimeCode)/timeCodesPerSecond: startTimeCode is at 0 s.
/// @throws UsageError "file:line:column: message"
TransformTrack read_usd_motion(const SourceText& source);
TransformTrack read_usd_motion(const std::filesystem::path& file);

/// Reads the same motion as a sphere track.
/// @throws UsageError also if nothing moves; a mesh moved only by its skeleton or its points is not a track
std::shared_ptr<const SphereTrack> read_sphere_track(const std::filesystem::path& file);

/// Motion of a mesh's points by a skeleton: linear blend skinning as UsdSkel defines it, without blend shapes,
///   p' = W Σⱼ wⱼ Sⱼ Bⱼ⁻¹ G p / Σⱼ wⱼ.
/// G is geomBindTransform and B the joint's bindTransform. S is the joint's transform in the skeleton: its own and its
/// parents' translation, rotation and scale from the SkelAnimation, or restTransform for joints without animation. W
/// maps the skeleton's coordinates to the world. The mesh's own transform is ignored.
/// See https://openusd.org/release/api/_usd_skel__schema_overview.html
class UsdSkin {
 public:
  /// Returns true if a mesh has a skin.
  static bool is_on(const UsdPath& mesh);

  /// Returns the skin of a mesh, if it has one. Skeleton, joints and weights may be inherited from ancestors.
  /// @throws UsageError "file:line:column: message"
  static std::optional<UsdSkin> of(const UsdStage& stage, const UsdPath& mesh);

  /// Returns the sample times [time codes] of the skeleton, its ancestors and its animation.
  [[nodiscard]] std::vector<double> times() const;

  /// Returns the map from skeleton to world coordinates, after geomBindTransform; it tells the front of the mesh.
  [[nodiscard]] Eigen::Affine3d bound_to_world(double time) const;

  /// Computes the positions of points at a time [time codes], in the world [m].
  /// @param points x, y, z of each, in the mesh's own coordinates
  void pose(double time, const std::vector<double>& points, Vertices& x) const;

 private:
  struct Influence {
    std::size_t joint = 0;
    double weight = 0;
  };

  UsdSkin(const UsdStage& stage, UsdPath skeleton) : stage_(&stage), skeleton_(std::move(skeleton)) {}
  void read_skeleton();
  void read_animation();
  void read_influences(const UsdPath& mesh);
  [[nodiscard]] std::vector<Eigen::Affine3d> joints_at(double time) const;

  const UsdStage* stage_;
  UsdPath skeleton_;
  std::vector<std::string> joints_;
  std::vector<std::optional<std::size_t>> parents_;  // parent of each joint; may come later in the list
  std::vector<Eigen::Affine3d> unbind_, rest_;  // per joint: Bⱼ⁻¹, and its rest transform relative to its parent
  const UsdPrim* animation_ = nullptr;
  std::vector<std::optional<std::size_t>> animated_;  // index of each joint in the animation
  Eigen::Affine3d geometry_ = Eigen::Affine3d::Identity();
  bool rigid_ = false;  // all points have the influences of the first
  std::size_t per_point_ = 1;
  std::vector<Influence> influences_;  // per_point_ for each point
};

}  // namespace drape
