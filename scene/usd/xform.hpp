#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "scene/usd/stage.hpp"

namespace drape {

/// Returns the transform from prim coordinates to the world, in metres with z up: the xformOps of the prim and its
/// ancestors in xformOpOrder, then the layer's unit and up axis. A y-up scene is turned by 90° about x. Operations are
/// interpolated linearly between samples, quaternions along the shortest arc, and are constant outside.
/// @param time [time codes]
/// @throws UsageError for an unknown operation, one of the wrong type, or a matrix that is not affine
Eigen::Affine3d world_transform(const UsdStage& stage, const UsdPath& path, double time);

/// Converts a USD matrix, whose 16 numbers act on row vectors, p′ = p·M, by transposing it.
/// @throws UsageError at the place unless it is affine
Eigen::Affine3d usd_affine(const double* m, const SourcePlace& place);

/// Returns the sample times [time codes] of all operations on a prim and its ancestors, increasing.
std::vector<double> transform_times(const UsdPath& path);

}  // namespace drape
