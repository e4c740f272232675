#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/mesh/options.hpp"
#include "sim/mesh.hpp"
#include "sim/mesh_motion.hpp"

namespace drape {

/// Reads a mesh from a Wavefront OBJ (.obj) or an ASCII USD file (.usda, or .usd with such content), in metres with z
/// up. See read_obj_mesh and read_usd_mesh for the supported parts of each format.
/// @param inputs if not null, receives every file read, including those that a USD file refers to
/// @throws UsageError "file:line:column: message", or "file: message" without a place
Mesh read_mesh(const std::filesystem::path& file, const MeshOptions& options = {},
               std::vector<std::filesystem::path>* inputs = nullptr);

/// Returns true for the name of an OBJ, which stores neither unit nor up axis.
bool is_obj(const std::filesystem::path& file);

/// Returns the vertices of the faces of a group or an object of an OBJ, ascending.
/// @throws UsageError if there is no such group, or the file is not OBJ
std::vector<int> read_mesh_group(const std::filesystem::path& file, const std::string& group);

/// Returns the vertices of a USD file's mesh where a primvar, one number per point, is not 0; ascending.
/// @throws UsageError if there is no such primvar, or the file is not USD
std::vector<int> read_mesh_primvar(const std::filesystem::path& file, const MeshOptions& options,
                                   const std::string& primvar);

/// Reads a mesh that may move, from a USD file (see read_usd_mesh_motion) or an OBJ sequence "body/{frame:04}.obj". The
/// files of a sequence have the same triangles; the first is at 0 s, then one every 1/frames_per_second. Any other mesh
/// stands still.
/// @param inputs as above
/// @throws UsageError as above, also if the frames of a sequence differ in triangles
MeshMotion read_mesh_motion(const std::filesystem::path& file, const MeshOptions& options = {},
                            std::vector<std::filesystem::path>* inputs = nullptr);

}  // namespace drape
