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

/// Boxes in a binary tree of the boxes around them, for finding those that are near something. When they move, the tree
/// is refitted: the same tree around other places.
class TriangleTree {
 public:
  /// Makes the tree: halves of the boxes along the longest side, down to leaves of a few.
  void build(std::span<const Box> boxes, int leaf_size = 4);
  /// Moves the boxes that it was built for.
  void refit(std::span<const Box> boxes);

  /// How far a point is from the box around all of them [m].
  [[nodiscard]] double distance(const Eigen::Vector3d& p) const {
    return std::sqrt(squared_distance(nodes_.front().box, p));
  }
  /// Around all of them; of none, it overlaps nothing.
  [[nodiscard]] const Box& bounds() const { return nodes_.front().box; }

  /// Calls visit(k) for every box k that overlaps the given one, and some that do not.
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

  /// Calls visit(k) for every box k that may hold something whose squared distance from a point is at most `limit`,
  /// which visits may lower: nearer ones first.
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
      // A little more than the limit: of two that are equally near to rounding, both are visited.
      if (squared > limit * (1 + 1e-12)) continue;
      const Node& node = nodes_[n];
      if (node.count > 0) {
        for (int k = node.first; k < node.first + node.count; ++k) visit(order_[static_cast<std::size_t>(k)]);
        continue;
      }
      const std::size_t left = n + 1;
      if (left == node.skip) continue;  // a tree of nothing
      const std::size_t right = nodes_[left].skip;
      Waiting near{left, squared_distance(nodes_[left].box, point)};
      Waiting far{right, squared_distance(nodes_[right].box, point)};
      if (far.squared < near.squared) std::swap(near, far);
      stack[height++] = far;
      stack[height++] = near;
    }
  }

 private:
  /// In the order in which they are visited: a node's first child follows it.
  struct Node {
    Box box;
    std::size_t skip;  // the node after all that is below this one
    int first, count;  // of the boxes of a leaf, in order_; none of others
  };
  static constexpr std::size_t most_depth = 128;  // halves of what an int counts, two of each wait at most

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
