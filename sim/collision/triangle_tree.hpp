#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "sim/collision/spatial_hash.hpp"

namespace drape {

/// Bounding-volume tree of boxes for proximity queries. When the boxes move, the tree is refitted and keeps its
/// structure.
class TriangleTree {
 public:
  /// Builds the tree: splits the boxes in halves along the longest side, down to small leaves.
  void build(std::span<const Box> boxes, int leaf_size = 4);
  /// Updates the positions of the same boxes.
  void refit(std::span<const Box> boxes);

  /// Returns the distance of a point from the root's box [m].
  [[nodiscard]] double distance(const Eigen::Vector3d& p) const {
    return std::sqrt(squared_distance(nodes_.front().box, p));
  }
  /// Returns the box around all boxes; without boxes it overlaps nothing.
  [[nodiscard]] const Box& bounds() const { return nodes_.front().box; }

  /// Calls visit(k) for every box k that overlaps the given one, and for some others.
  template <class Visit>
  void for_overlapping(const Box& box, Visit&& visit) const {
    for (std::size_t n = 0; n < nodes_.size();) {
      const Node& node = nodes_[n];
      if (!node.box.overlaps(box)) {
        n = node.skip;
        continue;
      }
      for (int k = node.first; k < node.first + node.count; ++k) visit(order_[static_cast<std::size_t>(k)]);
      ++n;
    }
  }

  /// Calls visit(boxes) for the boxes of every leaf.
  template <class Visit>
  void for_leaves(Visit&& visit) const {
    for (const Node& node : nodes_) {
      if (node.count > 0) {
        visit(std::span(order_).subspan(static_cast<std::size_t>(node.first), static_cast<std::size_t>(node.count)));
      }
    }
  }

  /// Calls visit(k) for every box k whose squared distance from a point is at most `limit`. Visits nearer boxes first
  /// and may lower the limit.
  template <class Visit>
  void for_nearest(const Eigen::Vector3d& point, const double& limit, Visit&& visit) const {
    struct Waiting {
      std::size_t node;
      double squared;
    };
    std::array<Waiting, most_depth> stack;
    std::size_t height = 0;
    stack[height++] = {0, squared_distance(nodes_.front().box, point)};
    while (height > 0) {
      const auto [n, squared] = stack[--height];
      // The slack makes sure that both of two distances equal up to rounding are visited.
      if (squared > limit * (1 + 1e-12)) continue;
      const Node& node = nodes_[n];
      if (node.count > 0) {
        for (int k = node.first; k < node.first + node.count; ++k) visit(order_[static_cast<std::size_t>(k)]);
        continue;
      }
      const std::size_t left = n + 1;
      if (left == node.skip) continue;  // an empty tree
      const std::size_t right = nodes_[left].skip;
      Waiting near{left, squared_distance(nodes_[left].box, point)};
      Waiting far{right, squared_distance(nodes_[right].box, point)};
      if (far.squared < near.squared) std::swap(near, far);
      stack[height++] = far;
      stack[height++] = near;
    }
  }

 private:
  /// Nodes in order of traversal: the first child follows its parent.
  struct Node {
    Box box;
    std::size_t skip;  // next node outside this subtree
    int first, count;  // range of a leaf's boxes in order_; empty for inner nodes
  };
  static constexpr std::size_t most_depth = 128;  // enough for any int count of boxes, with two waiting per level

  void split(std::span<const Box> boxes, int first, int count, int leaf_size);
  static double squared_distance(const Box& box, const Eigen::Vector3d& p) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double out = std::max({box.low[axis] - p[axis], p[axis] - box.high[axis], 0.0});
      sum += out * out;
    }
    return sum;
  }

  std::vector<Node> nodes_;
  std::vector<int> order_;
};

}  // namespace drape
