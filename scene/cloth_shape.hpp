#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "sim/cloth.hpp"

namespace drape {

/// How large a cloth is where it starts, for people to see whether it is what they meant.
struct ClothShape {
  int pieces = 0;                              ///< that springs hold together; vertices without one are none
  Eigen::Vector3d extent;                      ///< of its bounding box [m]
  double shortest_edge = 0, longest_edge = 0;  ///< [m]

  /// "2 pieces of 2 × 2 × 0 m together, edges of 0.1 to 0.141 m"
  [[nodiscard]] std::string text() const;

  /// What is odd about a cloth of this size; nothing if nothing is.
  [[nodiscard]] std::optional<std::string> doubt() const;
};

ClothShape shape_of(const Cloth& cloth);

/// Whether a mesh looks as if y pointed up in it: it stands on the plane y = 0, or it lies in such a plane. Both may be
/// meant in a file in which z points up, so this is worth a hint and no more.
bool seems_y_up(const Vertices& positions);

}  // namespace drape
