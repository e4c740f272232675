#pragma once

// Example:
//   drape::BodyShape pillar{.kind = drape::BodyShape::Kind::cylinder, .radius = 0.2, .height = 1.5};
//   drape::Body body{.center = Eigen::Vector3d(0, 0, 0.75), .shape = pillar};

#include <optional>
#include <string>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

class Keys;

/// A shape around the origin with its axis along z. All lengths are in m.
struct BodyShape {
  enum class Kind { cylinder, capsule, cone, plane, sphere };

  Kind kind = Kind::sphere;
  double radius = 0.5;  ///< of all kinds except the plane; of a cone at its base
  double height = 1;    ///< of a cylinder, a cone, and a capsule including its caps
  double top = 0;       ///< radius of a cone's upper end
  double width = 1;     ///< of a plane along x
  double depth = 1;     ///< of a plane along y
  int segments = 64;    ///< around the axis

  bool operator==(const BodyShape&) const = default;
};

/// The key of a body that gives it a shape of this kind; the target of an CustomValue.
struct BodyShapeKey {
  BodyShape::Kind kind;
  std::optional<BodyShape>* shape;
};

/// Returns the names of the kinds, in the order of Kind: "cylinder" and so on.
const std::vector<std::string>& body_shape_names();

/// Returns the keys of the table for a shape of its kind.
/// @param shape must outlive the keys
Keys body_shape_keys(BodyShape& shape);

/// Returns the reason if the shape is invalid; otherwise nothing.
std::optional<std::string> body_shape_problem(const BodyShape& shape);

/// Returns a mesh of the shape, counterclockwise seen from outside. It is closed except for a plane, which faces up.
Mesh make_body_shape(const BodyShape& shape);

}  // namespace drape
