#pragma once

#include <vector>

#include "audit/box_tree.hpp"
#include "sim/mesh.hpp"

namespace drape::audit {

/// Copies positions onto the grid on which predicates are exact, see `on_exact_grid`.
/// @throws std::invalid_argument naming the vertex if a coordinate is not finite or too large
Vertices exact_positions(const Vertices& x);

/// The box of each feature's vertices at both ends of a step.
/// @param features of 1, 2 or 3 vertices each
template <std::size_t count>
std::vector<Box> swept_boxes(const std::vector<std::array<int, count>>& features, const Vertices& from,
                             const Vertices& to) {
  std::vector<Box> boxes;
  boxes.reserve(features.size());
  for (const std::array<int, count>& feature : features) {
    Box box{from.row(feature[0]).transpose().array(), from.row(feature[0]).transpose().array()};
    for (const int v : feature) {
      const Eigen::Array3d a = from.row(v).transpose().array(), b = to.row(v).transpose().array();
      box.include({a.min(b), a.max(b)});
    }
    boxes.push_back(box);
  }
  return boxes;
}

/// @throws std::invalid_argument if a triangle names a vertex that there is not
void check_vertices(const std::vector<Triangle>& triangles, const Vertices& x);

/// True where two features of one mesh have a vertex in common.
template <std::size_t first, std::size_t second>
bool share_vertex(const std::array<int, first>& a, const std::array<int, second>& b) {
  for (const int v : a) {
    for (const int w : b) {
      if (v == w) return true;
    }
  }
  return false;
}

}  // namespace drape::audit
