#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drape/scene/document.hpp"
#include "drape/sim/cloth.hpp"
#include "scene/selection.hpp"
#include "scene/tables.hpp"

namespace drape {

/// A cloth and its texture coordinates.
struct ClothAndUvs {
  Cloth cloth;
  std::vector<std::array<float, 2>> uvs;      ///< see Mesh::uvs
  SelectableMesh mesh;                        ///< mesh before [cloth.transform]
  std::vector<std::filesystem::path> inputs;  ///< files that the cloth was read from
  std::vector<std::string> warnings;          ///< warnings about the mesh, a sentence each
};

/// Makes the cloth that a [cloth] table describes.
/// @param table  values of its keys; `mesh`, `rest`, `pins` and `scale` are read here
/// @param value  the table itself, for the places of problems
/// @param folder folder of the scene, which holds its mesh files
/// @returns nothing if there were problems
std::optional<ClothAndUvs> read_cloth(const ClothTable& table, const TomlValue& value,
                                      const std::filesystem::path& folder, Problems& problems);

/// Reads an array of vertices. Items are numbers from 0; "corner:x-y+", the vertex farthest in that direction (the
/// first of several); "edge:x-", all vertices farthest in that direction; "border", the border of the mesh; and tables
/// that select at least one vertex, see read_selection().
/// @param mesh null if it could not be read: then only the forms are checked
/// @returns vertices, ascending and unique
std::vector<int> read_pins(const TomlValue& value, const SelectableMesh* mesh, Problems& problems);

}  // namespace drape
