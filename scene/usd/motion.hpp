#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <vector>

#include "scene/mesh/source.hpp"
#include "scene/usd/stage.hpp"
#include "sim/sphere_track.hpp"

namespace drape {

/// Where something is over time, and a sphere around it.
struct TransformTrack {
  std::vector<double> times;                ///< of the samples, increasing [s]; at least one
  std::vector<Eigen::Affine3d> transforms;  ///< one per time: from the thing's own coordinates to the world's [m]

  /// The bounding sphere in the thing's own coordinates and units: around the middle of the bounding box of its points.
  /// For an icosphere or a UV sphere that is the sphere itself; radius 0 for a thing without a shape.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;

  /// The transform at a time [s]: linear between the samples, each number of the matrix by itself as USD does it (so
  /// sample rotations densely); before the first and after the last sample that sample.
  [[nodiscard]] Eigen::Affine3d at(double time) const;

  /// The bounding sphere at a time [s], in the world [m]. Where the transform stretches it, it is the sphere of its
  /// longest half-axis.
  [[nodiscard]] SphereShape sphere_at(double time) const;
};

/// The motion of a prim by its transform and those of its ancestors. One that nothing moves has one sample.
/// @throws UsageError "file:line:column: message"
TransformTrack read_usd_track(const UsdStage& stage, const UsdPath& path);

/// The motion of the first Mesh or Sphere of an ASCII USD file that moves; if none moves, the first Mesh or Sphere,
/// with one sample; if there is none, the first prim of any type that moves. The time of a sample is (time code −
/// startTimeCode)/timeCodesPerSecond: at startTimeCode the clock shows 0 s.
/// @throws UsageError "file:line:column: message"
TransformTrack read_usd_motion(const SourceText& source);
TransformTrack read_usd_motion(const std::filesystem::path& file);

/// The same motion for whoever follows it.
/// @throws UsageError also if nothing moves: a mesh that only its skeleton or its points move is no track
std::shared_ptr<const SphereTrack> read_sphere_track(const std::filesystem::path& file);

}  // namespace drape
