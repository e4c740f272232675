#pragma once

#include <initializer_list>
#include <vector>

#include "audit/box_tree.hpp"
#include "sim/mesh.hpp"

namespace drape::audit {

/// Copies positions onto the grid on which predicates are exact, see `on_exact_grid`.
/// @throws std::invalid_argument naming the vertex if a coordinate is not finite or too large
Vertices exact_positions(const Vertices& x);

/// The box of each feature's vertices at all of some places.
/// @param features of 1, 2 or 3 vertices each
template <std::size_t count>
std::vector<Box> boxes_around(const std::vector<std::array<int, count>>& features,
                              std::initializer_list<const Vertices*> places) {
  std::vector<Box> boxes;
  boxes.reserve(features.size());
  for (const std::array<int, count>& feature : features) {
    const Eigen::Array3d first = (*places.begin())->row(feature[0]).transpose().array();
    Box box{first, first};
    for (const int v : feature) {
      for (const Vertices* place : places) {
        const Eigen::Array3d x = place->row(v).transpose().array();
        box.include({x, x});
      }
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
