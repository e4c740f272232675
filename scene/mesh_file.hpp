#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/mesh/options.hpp"
#include "sim/mesh.hpp"
#include "sim/mesh_motion.hpp"

namespace drape {

/// Reads a mesh from a Wavefront OBJ (.obj) or an ASCII USD file (.usda, or .usd with such content), in metres with z
/// up. What is read of each format: see read_obj_mesh and read_usd_mesh.
/// @param inputs where not null, every file that is read for it is added: also those that a USD file refers to
/// @throws UsageError "file:line:column: message", or "file: message" where no place is at fault
Mesh read_mesh(const std::filesystem::path& file, const MeshOptions& options = {},
               std::vector<std::filesystem::path>* inputs = nullptr);

/// Whether a name is that of an OBJ, which says neither its unit nor its up axis.
bool is_obj(const std::filesystem::path& file);

/// The vertices of the faces of a group or an object of an OBJ, ascending.
/// @throws UsageError if there is no such group, or the file is no OBJ
std::vector<int> read_mesh_group(const std::filesystem::path& file, const std::string& group);

/// The vertices of a USD file's mesh at which one of its primvars, a number for each point, is not 0; ascending.
/// @throws UsageError if there is no such primvar, or the file is no USD
std::vector<int> read_mesh_primvar(const std::filesystem::path& file, const MeshOptions& options,
                                   const std::string& primvar);

/// Reads a mesh that may move: that of a USD file (see read_usd_mesh_motion), or an OBJ sequence,
/// "body/{frame:04}.obj": files with the same triangles, the first at 0 s and one every 1/frames_per_second. Any other
/// mesh stands still.
/// @param inputs as above
/// @throws UsageError as above, also where the frames of a sequence do not have the same triangles
MeshMotion read_mesh_motion(const std::filesystem::path& file, const MeshOptions& options = {},
                            std::vector<std::filesystem::path>* inputs = nullptr);

}  // namespace drape
