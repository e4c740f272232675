#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/document.hpp"
#include "scene/mesh/options.hpp"
#include "scene/problems.hpp"
#include "sim/grid.hpp"

namespace drape {

/// A reference to a mesh file in a scene.
struct MeshName {
  std::filesystem::path file;  ///< file name as the scene writes it
  MeshOptions options;
};

/// Reads the reference to a mesh, "cloth.obj" or { file = "cloth.usda", prim = "/World/cloth" }. `up = "y"` gives the
/// up axis of an OBJ; `fps` gives the frame rate of an OBJ sequence if the mesh may move.
std::optional<MeshName> read_mesh_name(const TomlValue& value, const std::string& name, bool may_move,
                                       Problems& problems);

/// Returns the grid of a mesh value that was read before; nothing for a mesh from a file.
std::optional<Grid> grid_of(const TomlValue& value);

/// Reads a mesh: { grid = [columns, rows] } with a `pattern` and a `size`, or a reference as above.
/// @param folder folder of the scene, which holds its files
/// @param inputs receives every file read
std::optional<Mesh> read_mesh_value(const TomlValue& value, const std::string& name,
                                    const std::filesystem::path& folder, std::vector<std::filesystem::path>& inputs,
                                    Problems& problems);

}  // namespace drape
