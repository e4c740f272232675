#pragma once

#include <array>
#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "drape/scene/document.hpp"
#include "drape/sim/cloth.hpp"
#include "scene/selection.hpp"
#include "scene/table_reader.hpp"
#include "scene/tables.hpp"

namespace drape {

/// The cloths of a scene, joined into one, and its seams.
struct ClothList {
  std::deque<ClothTable> tables;  ///< values of each [cloth]
  std::deque<SeamTable> seams;    ///< values of each [seam]
  Cloth cloth;
  std::vector<std::array<float, 2>> uvs;      ///< see Mesh::uvs; zero for cloths without any beside others
  std::deque<PlacedSelection> meshes;         ///< of the cloths, before their transforms
  std::vector<std::filesystem::path> inputs;  ///< files that they were read from
  std::vector<std::string> warnings;          ///< with their places
  bool good = false;                          ///< true if all were read without a problem
};

/// Reads every [cloth] and [seam] of a document.
/// @param folder folder of the scene, which holds its mesh files
ClothList read_cloths(const TomlValue& document, TableReader& reader, const std::filesystem::path& folder,
                      Problems& problems);

/// Returns the looks of several cloths; empty for one. That one's own colour and texture replace those of `look`.
/// @param cloth all cloths, joined
std::vector<ClothLook> cloth_looks(const ClothList& cloths, const Cloth& cloth, const TomlValue& document,
                                   const Problems& problems, Look& look);

/// Returns every table of a scene with its path: those of several cloths are cloth.NAME and cloth.NAME.transform.
std::vector<TableType> named_tables(ClothList& cloths, Scene& scene);

}  // namespace drape
