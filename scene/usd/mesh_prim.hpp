#pragma once

#include <Eigen/Geometry>
#include <string_view>

#include "scene/usd/stage.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// Returns the first value of an array attribute of a prim.
/// @param components see UsdAttribute
/// @throws UsageError if the prim has none, or it has another shape
const UsdValue& usd_array(const UsdPrim& prim, std::string_view name, std::size_t components);

/// Reads the mesh of a Mesh prim with the first sample of its points. Left-handed meshes and those mirrored by
/// `to_world` are flipped, so that triangles are counterclockwise seen from the front.
/// @throws UsageError "file:line:column: message"
Mesh read_mesh_prim(const UsdPrim& prim, const Eigen::Affine3d& to_world);

}  // namespace drape
