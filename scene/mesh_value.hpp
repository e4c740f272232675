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

/// A mesh that a scene names.
struct MeshName {
  std::filesystem::path file;  ///< as the scene has it
  MeshOptions options;
};

/// Reads the name of a mesh, "cloth.obj", or { file = "cloth.usda", prim = "/World/cloth" }; `up = "y"` beside `file`
/// says which axis an OBJ means, and `fps`, of one that may move, how fast an OBJ sequence is.
std::optional<MeshName> read_mesh_name(const TomlValue& value, const std::string& name, bool may_move,
                                       Problems& problems);

/// The grid that a mesh which has been read is; nothing where it is from a file.
std::optional<Grid> grid_of(const TomlValue& value);

/// Reads a mesh: { grid = [columns, rows] }, of a `pattern` and a `size`, or one that is named as above.
/// @param folder the scene's, where its files are
/// @param inputs every file that is read for it is added
std::optional<Mesh> read_mesh_value(const TomlValue& value, const std::string& name,
                                    const std::filesystem::path& folder, std::vector<std::filesystem::path>& inputs,
                                    Problems& problems);

}  // namespace drape
