#pragma once

#include <initializer_list>
#include <vector>

#include "audit/box_tree.hpp"
#include "sim/mesh.hpp"

namespace drape::audit {

/// Rounds positions to the grid of exact predicates, see `on_exact_grid`.
/// @throws std::invalid_argument naming the vertex if a coordinate is non-finite or too large
Vertices exact_positions(const Vertices& x);

/// Returns the bounding box of each feature over several arrays of positions.
/// @param features features of 1, 2 or 3 vertices each
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

/// @throws std::invalid_argument if a triangle has an invalid vertex
void check_vertices(const std::vector<Triangle>& triangles, const Vertices& x);

/// Returns true if two features of one mesh share a vertex.
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
