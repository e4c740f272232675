#pragma once

#include <Eigen/Geometry>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "scene/usd/layer.hpp"

namespace drape {

/// A prim with its ancestors, from the root of the tree down to the prim itself.
using UsdPath = std::vector<const UsdPrim*>;

/// The defined prims of the given types, in the order of the file; of any type where none is given. They point into the
/// layer.
std::vector<UsdPath> find_prims(const UsdLayer& layer, std::initializer_list<std::string_view> types);

/// "/root/Grid"
std::string path_text(const UsdPath& path);

/// From the coordinates of a prim to the world's, in metres with z up: its xformOps and those of its ancestors as
/// xformOpOrder lists them, then the layer's unit and up axis. A y-up scene is turned by 90° about x.
/// Between its samples an operation is interpolated linearly, a quaternion along the shortest arc; outside of them it
/// stays at the nearest.
/// @param time [time codes]
/// @throws UsageError for an operation that does not exist or does not have its type, or a matrix that is not affine
Eigen::Affine3d world_transform(const SourceText& source, const UsdLayer& layer, const UsdPath& path, double time);

/// The times [time codes], increasing, at which some operation on a prim or its ancestors has a sample.
std::vector<double> transform_times(const UsdPath& path);

}  // namespace drape
