#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/problems.hpp"
#include "scene/selection.hpp"
#include "scene/tables.hpp"
#include "sim/cloth.hpp"

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

}  // namespace drape
