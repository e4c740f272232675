#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "scene/usd/stage.hpp"

namespace drape {

/// From the coordinates of a prim to the world's, in metres with z up: its xformOps and those of its ancestors as
/// xformOpOrder lists them, then the layer's unit and up axis. A y-up scene is turned by 90° about x.
/// Between its samples an operation is interpolated linearly, a quaternion along the shortest arc; outside of them it
/// stays at the nearest.
/// @param time [time codes]
/// @throws UsageError for an operation that does not exist or does not have its type, or a matrix that is not affine
Eigen::Affine3d world_transform(const UsdStage& stage, const UsdPath& path, double time);

/// A matrix of USD, whose 16 numbers act on row vectors, p′ = p·M: ours is the transpose.
/// @throws UsageError at the place unless it is affine
Eigen::Affine3d usd_affine(const double* m, const SourcePlace& place);

/// The times [time codes], increasing, at which some operation on a prim or its ancestors has a sample.
std::vector<double> transform_times(const UsdPath& path);

}  // namespace drape
