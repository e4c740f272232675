#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/keys.hpp"
#include "drape/scene/document.hpp"
#include "drape/sim/body_shape.hpp"
#include "drape/sim/mesh.hpp"
#include "scene/mesh/source.hpp"

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

/// A parametric mesh. All lengths in m.
struct ParametricMesh {
  enum class Kind { disc, strip, tube };

  Kind kind = Kind::disc;
  double radius = 1;               ///< radius of a disc, or of a tube at its upper end
  std::optional<double> hem = {};  ///< radius of a tube's lower end; absent: `radius`
  double length = 2;               ///< length of a strip along x, of a tube along z
  double width = 0.2;              ///< width of a strip along y
  int rings = 16;                  ///< edges of a disc from the centre to the border
  int across = 4;                  ///< cells of a strip along y; the number along x makes them square
  int around = 48;                 ///< cells around a tube's axis; the number along it makes them square
};

/// Returns the names of the shapes in scenes, in the order of the kinds: "disc", "strip", "tube".
const std::vector<std::string>& mesh_shape_names();

/// Returns the keys of the table for the shape's kind.
/// @param shape must outlive the keys
Keys mesh_shape_keys(ParametricMesh& shape);

/// Makes the mesh of a shape around the origin, with texture coordinates that cover it once. A disc and a strip lie at
/// z = 0; a tube's axis is z.
/// @throws std::invalid_argument if it would have more than eight million triangles
Mesh make_mesh_shape(const ParametricMesh& shape);

/// Returns the shape that a value names, { disc = … }; nothing for other values.
std::optional<ParametricMesh::Kind> mesh_shape_kind(const TomlValue& value);

/// Reads { disc = { radius = 1, rings = 16 } } and similar tables.
/// @param value a value with a mesh_shape_kind()
std::optional<Mesh> read_mesh_shape(const TomlValue& value, const std::string& name, Problems& problems);

}  // namespace drape
