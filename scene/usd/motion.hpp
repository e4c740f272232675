#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <vector>

#include "scene/mesh/source.hpp"
#include "scene/usd/stage.hpp"
#include "sim/sphere_track.hpp"

namespace drape {

/// A transform over time, with the bounding sphere of the transformed object.
struct TransformTrack {
  std::vector<double> times;                ///< sample times, increasing [s]; at least one
  std::vector<Eigen::Affine3d> transforms;  ///< one per time: from object to world coordinates [m]

  /// Bounding sphere in object coordinates and units, around the middle of the bounding box of the points. For an
  /// icosphere or a UV sphere that is the sphere itself; an object without a shape has radius 0.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;

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

}  // namespace drape
