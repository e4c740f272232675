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

/// A mesh that a scene describes by a few numbers. All lengths in m.
struct SheetShape {
  enum class Kind { disc, strip, tube };

  Kind kind = Kind::disc;
  double radius = 1;               ///< of a disc; of a tube at its upper end
  std::optional<double> hem = {};  ///< radius of a tube's lower end; absent: the same
  double length = 2;               ///< of a strip along x, of a tube along z
  double width = 0.2;              ///< of a strip along y
  int rings = 16;                  ///< of a disc: edges from the centre to the border
  int across = 4;                  ///< cells of a strip along y; along x as many as make them square
  int around = 48;                 ///< cells of a tube around its axis; along it as many as make them square
};

/// Their names in a scene, in the order of the kinds: "disc", "strip", "tube".
const std::vector<std::string>& mesh_shape_names();

/// The keys of the table of a shape of its kind.
/// @param shape must outlive the keys
Keys mesh_shape_keys(SheetShape& shape);

/// The mesh of a shape around the origin, with texture coordinates that cover it once. A disc and a strip lie at z = 0;
/// a tube's axis is z.
/// @throws std::invalid_argument if it would have more than eight million triangles
Mesh make_mesh_shape(const SheetShape& shape);

/// Which shape a value names, { disc = … }; nothing if it names none.
std::optional<SheetShape::Kind> mesh_shape_kind(const TomlValue& value);

/// Reads { disc = { radius = 1, rings = 16 } } and the like.
/// @param value of which mesh_shape_kind() is something
std::optional<Mesh> read_mesh_shape(const TomlValue& value, const std::string& name, Problems& problems);

}  // namespace drape
