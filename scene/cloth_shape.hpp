#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "sim/cloth.hpp"

namespace drape {

/// Initial size of a cloth, shown to users so that they can check it.
struct ClothShape {
  int pieces = 0;                              ///< connected components with at least one spring
  Eigen::Vector3d extent;                      ///< size of the bounding box [m]
  double shortest_edge = 0, longest_edge = 0;  ///< [m]

  /// Returns for example "2 pieces of 2 × 2 × 0 m together, edges of 0.1 to 0.141 m".
  [[nodiscard]] std::string text() const;

  /// Returns a warning about an unusual size, if any.
  [[nodiscard]] std::optional<std::string> doubt() const;
};

ClothShape shape_of(const Cloth& cloth);

/// Returns true if a mesh looks y-up: flat along y, or standing above y = 0 with its depth centred on z = 0. A z-up
/// mesh may look so as well; this justifies only a hint.
bool seems_y_up(const Vertices& positions);

}  // namespace drape
