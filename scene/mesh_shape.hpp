#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/keys.hpp"
#include "scene/document.hpp"
#include "scene/problems.hpp"
#include "sim/mesh.hpp"

namespace drape {

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
