#pragma once

#include <array>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drape/scene/document.hpp"
#include "drape/sim/cloth.hpp"
#include "scene/selection.hpp"
#include "scene/table_reader.hpp"
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
/// @param name of the key, for messages
/// @param mesh null if it could not be read: then only the forms are checked
/// @returns vertices, ascending and unique
std::vector<int> read_vertices(const TomlValue& value, const std::string& name, const SelectableMesh* mesh,
                               Problems& problems);

/// Makes the seam that a [seam] table describes. The vertices of each side form an open path along the edges of its
/// cloth. Both are measured by their length in the rest shape, from 0 to 1. Each vertex of the side with more vertices
/// is tied to the point of the other side at the same share of the length. Side b runs in the direction that keeps the
/// ties shorter at the start, or the other with `reverse`.
/// @param value the table, for the places of problems
/// @param cloth all cloths, joined
/// @returns nothing if there were problems
std::optional<Seam> read_seam(const SeamTable& table, const TomlValue& value, const Cloth& cloth,
                              const std::deque<PlacedSelection>& meshes, Problems& problems);

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

}  // namespace drape
