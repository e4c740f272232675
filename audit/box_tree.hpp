#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <initializer_list>
#include <vector>

#include "audit/crossings.hpp"
#include "drape/sim/mesh.hpp"

namespace drape::audit {

/// An axis-aligned box, including its boundary.
struct Box {
  Eigen::Array3d low, high;

  [[nodiscard]] bool meets(const Box& other) const {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] && other.low[1] <= high[1] &&
           low[2] <= other.high[2] && other.low[2] <= high[2];
  }
  void include(const Box& other) {
    low = low.min(other.low);
    high = high.max(other.high);
  }
};

/// A balanced binary tree of boxes that finds intersecting pairs. Comparisons are exact, so no pair is missed.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes);

  /// Calls visit(i, j) once for each intersecting pair i < j of this tree.
  template <class Visit>
  void for_pairs(Visit visit) const {
    if (!nodes_.empty()) within(0, visit);
  }

  /// Calls visit(i, j) once for each intersecting pair of box i of this tree and box j of the other.
  template <class Visit>
  void for_pairs_with(const BoxTree& other, Visit visit) const {
    if (!nodes_.empty() && !other.nodes_.empty()) across(0, other, 0, visit);
  }

 private:
  struct Node {
    Box box;
    int begin, end;  // range in order_
    int second;      // index of the second child; the first follows the node; leaf: −1
  };

  void build(int begin, int end);

  template <class Visit>
  void within(int n, Visit& visit) const {
    const Node& node = nodes_[static_cast<std::size_t>(n)];
    if (node.second >= 0) {
      within(n + 1, visit);
      within(node.second, visit);
      across(n + 1, *this, node.second, visit);
      return;
    }
    for (int i = node.begin; i < node.end; ++i) {
      for (int j = i + 1; j < node.end; ++j) {
        const int a = order_[static_cast<std::size_t>(i)], b = order_[static_cast<std::size_t>(j)];
        if (box(a).meets(box(b))) visit(std::min(a, b), std::max(a, b));
      }
    }
  }

  template <class Visit>
  void across(int n, const BoxTree& other, int m, Visit& visit) const {
    const Node& a = nodes_[static_cast<std::size_t>(n)];
    const Node& b = other.nodes_[static_cast<std::size_t>(m)];
    if (!a.box.meets(b.box)) return;
    if (a.second < 0 && b.second < 0) {
      leaves(a, other, b, visit);
    } else if (b.second < 0 || (a.second >= 0 && a.end - a.begin >= b.end - b.begin)) {
      across(n + 1, other, m, visit);
      across(a.second, other, m, visit);
    } else {
      across(n, other, m + 1, visit);
      across(n, other, b.second, visit);
    }
  }

  template <class Visit>
  void leaves(const Node& a, const BoxTree& other, const Node& b, Visit& visit) const {
    for (int i = a.begin; i < a.end; ++i) {
      const int first = order_[static_cast<std::size_t>(i)];
      for (int j = b.begin; j < b.end; ++j) {
        const int second = other.order_[static_cast<std::size_t>(j)];
        if (!box(first).meets(other.box(second))) continue;
        if (this == &other) {
          visit(std::min(first, second), std::max(first, second));
        } else {
          visit(first, second);
        }
      }
    }
  }

  [[nodiscard]] const Box& box(int i) const { return boxes_[static_cast<std::size_t>(i)]; }

  std::vector<Box> boxes_;
  std::vector<int> order_;  // the boxes of a node are consecutive
  std::vector<Node> nodes_;
};

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

/// Checks that all vertices of the triangles exist.
/// @throws std::invalid_argument if a triangle has an invalid vertex
void check_vertices(const std::vector<Triangle>& triangles, const Vertices& x);

/// Returns true if two features of one mesh share a vertex, or have vertices that a seam ties together.
template <std::size_t first, std::size_t second>
bool share_vertex(const Topology& mesh, const std::array<int, first>& a, const std::array<int, second>& b) {
  for (const int v : a) {
    for (const int w : b) {
      if (v == w) return true;
      if (!mesh.sewn.empty() && std::ranges::binary_search(mesh.sewn, Edge{std::min(v, w), std::max(v, w)}))
        return true;
    }
  }
  return false;
}

}  // namespace drape::audit
