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

/// A cloth and how a picture is laid on it.
struct ClothAndUvs {
  Cloth cloth;
  std::vector<std::array<float, 2>> uvs;      ///< see Mesh::uvs
  SelectableMesh mesh;                        ///< as it was before [cloth.transform]
  std::vector<std::filesystem::path> inputs;  ///< the files that it was read from
  std::vector<std::string> doubts;            ///< what may not be meant about its mesh, a sentence each
};

/// Makes the cloth that a [cloth] table describes.
/// @param table  what its keys say; `mesh`, `rest`, `pins` and `scale` are read here
/// @param value  the table itself, for the places of problems
/// @param folder the scene's, where its mesh files are
/// @returns nothing if there were problems
std::optional<ClothAndUvs> read_cloth(const ClothTable& table, const TomlValue& value,
                                      const std::filesystem::path& folder, Problems& problems);

}  // namespace drape
