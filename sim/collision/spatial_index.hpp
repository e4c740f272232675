#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace drape {

/// Axis-aligned box [m]. Initially it is empty and intersects no finite box.
using Box = Eigen::AlignedBox3d;

/// Returns the box, enlarged by a margin on each side [m].
inline Box larger(const Box& box, double margin) { return {box.min().array() - margin, box.max().array() + margin}; }

/// Returns the box around the straight paths of some vertices.
inline Box box_of_paths(std::span<const int> vertices, const std::vector<Eigen::Vector3d>& from,
                        const std::vector<Eigen::Vector3d>& to) {
  Box box;
  for (const int v : vertices) box.extend(from[static_cast<std::size_t>(v)]).extend(to[static_cast<std::size_t>(v)]);
  return box;
}

/// Uniform hash grid that finds overlapping boxes in nearly linear time (Teschner et al. 2003, "Optimized spatial
/// hashing for collision detection of deformable objects"). Cells are twice the mean size of the boxes, or larger if a
/// few huge boxes would fill too many. Each overlapping pair is visited once: in the cell of the lowest corner of the
/// pair's intersection.
class SpatialHash {
 public:
  /// Replaces the boxes and reuses memory. The boxes must outlive the visits.
  void build(std::span<const Box> boxes);

  /// Calls visit(k) for every box k that overlaps the given one.
  template <class Visit>
  void for_overlapping(const Box& box, Visit&& visit) const {
    if (boxes_.empty()) return;
    const Cell low = cell_of(box.min()), high = cell_of(box.max());
    const Rounded rounded = round(box);
    Cell cell;
    for (cell.z = std::max(low.z, 0); cell.z <= std::min(high.z, count_.z - 1); ++cell.z) {
      for (cell.y = std::max(low.y, 0); cell.y <= std::min(high.y, count_.y - 1); ++cell.y) {
        for (cell.x = std::max(low.x, 0); cell.x <= std::min(high.x, count_.x - 1); ++cell.x) {
          const std::uint64_t key = key_of(cell);
          const std::size_t slot = slot_of(key);
          for_near(rounded, start_of(slot), start_of(slot + 1), [&](const Entry& entry) {
            if (entry.key != key || !is_first(cell, low, lows_[static_cast<std::size_t>(entry.box)])) return;
            if (box.intersects(boxes_[static_cast<std::size_t>(entry.box)])) visit(entry.box);
          });
        }
      }
    }
  }

  /// Calls visit(l) for every box l > k that overlaps box k. Calls for all k visit each overlapping pair once.
  template <class Visit>
  void for_later(int k, Visit&& visit) const {
    const auto box = static_cast<std::size_t>(k);
    const Rounded rounded = round(boxes_[box]);
    for (auto n = static_cast<std::size_t>(ends_[box]); n < static_cast<std::size_t>(ends_[box + 1]); ++n) {
      const auto e = static_cast<std::size_t>(places_[n]);
      const std::uint64_t key = entries_[e].key;
      // Entries of a slot are in the order of the boxes.
      for_near(rounded, e + 1, start_of(slot_of(key) + 1), [&](const Entry& other) {
        const auto l = static_cast<std::size_t>(other.box);
        if (other.key != key || l == box || !is_first(cell_at(key), lows_[box], lows_[l])) return;
        if (boxes_[box].intersects(boxes_[l])) visit(other.box);
      });
    }
  }

 private:
  struct Cell {
    int x = 0, y = 0, z = 0;
  };
  /// One box in one cell.
  struct Entry {
    std::uint64_t key;
    int box;
  };

  [[nodiscard]] Cell cell_of(const Eigen::Vector3d& place) const {
    return {index((place.x() - origin_.x()) * inverse_size_), index((place.y() - origin_.y()) * inverse_size_),
            index((place.z() - origin_.z()) * inverse_size_)};
  }
  /// Rounds down and clamps; anything below zero gives −1.
  static int index(double place) {
    return static_cast<int>(std::min(std::max(place, -1.0), static_cast<double>(cells_per_axis)) + 1) - 1;
  }
  static constexpr unsigned axis_bits = 21;
  static std::uint64_t key_of(const Cell& c) {
    return static_cast<std::uint64_t>(c.x) | static_cast<std::uint64_t>(c.y) << axis_bits |
           static_cast<std::uint64_t>(c.z) << (2 * axis_bits);
  }
  static Cell cell_at(std::uint64_t key) {
    constexpr std::uint64_t mask = (std::uint64_t{1} << axis_bits) - 1;
    return {static_cast<int>(key & mask), static_cast<int>(key >> axis_bits & mask),
            static_cast<int>(key >> (2 * axis_bits))};
  }
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const {
    return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15U) >> shift_);  // Fibonacci hashing (Knuth, section 6.4)
  }
  /// Returns true if a cell holds the lowest corner of the intersection of two boxes, given the cells of their lowest
  /// corners.
  static bool is_first(const Cell& cell, const Cell& a, const Cell& b) {
    return std::max(a.x, b.x) == cell.x && std::max(a.y, b.y) == cell.y && std::max(a.z, b.z) == cell.z;
  }
  /// Box relative to the origin in single precision: lowest x, y, z, highest x, y, z. Rounding is monotonic, so
  /// overlaps are preserved.
  using Rounded = std::array<float, 6>;
  [[nodiscard]] Rounded round(const Box& box) const {
    Rounded rounded{};
    for (int axis = 0; axis < 3; ++axis) {
      rounded[static_cast<std::size_t>(axis)] = static_cast<float>(box.min()[axis] - origin_[axis]);
      rounded[static_cast<std::size_t>(axis) + 3] = static_cast<float>(box.max()[axis] - origin_[axis]);
    }
    return rounded;
  }
  /// Calls visit(entry) for the entries in a range whose rounded box overlaps this one.
  template <class Visit>
  void for_near(const Rounded& box, std::size_t begin, std::size_t end, Visit&& visit) const {
    constexpr std::uint64_t ones = 0x0101010101010101U;
    for (std::size_t first = begin; first < end; first += at_once) {
      const Bytes apart = compare(box, first);
      for (std::size_t w = 0; w < apart.size() && first + 8 * w < end; ++w) {
        // Sets one bit for each byte that is 0.
        std::uint64_t near = ~apart[w] & ones;
        const std::size_t e = first + 8 * w;
        if (end - e < 8) near &= (std::uint64_t{1} << (8 * (end - e))) - 1;
        for (; near != 0; near &= near - 1) visit(entries_[e + static_cast<std::size_t>(std::countr_zero(near)) / 8]);
      }
    }
  }
  static constexpr std::size_t at_once = 16;  // entries compared together
  using Bytes = std::array<std::uint64_t, at_once / 8>;
  /// Compares a box with consecutive entries; a byte is 1 if the rounded boxes are apart.
  [[nodiscard]] Bytes compare(const Rounded& box, std::size_t first) const {
    std::array<const float*, 6> r{};
    for (std::size_t k = 0; k < r.size(); ++k) r[k] = rounded_[k].data() + first;
    const auto& [lx, ly, lz, hx, hy, hz] = r;
    std::array<unsigned char, at_once> apart{};
    for (std::size_t k = 0; k < at_once; ++k) {
      apart[k] = static_cast<unsigned char>(static_cast<int>(lx[k] > box[3]) | static_cast<int>(ly[k] > box[4]) |
                                            static_cast<int>(lz[k] > box[5]) | static_cast<int>(hx[k] < box[0]) |
                                            static_cast<int>(hy[k] < box[1]) | static_cast<int>(hz[k] < box[2]));
    }
    return std::bit_cast<Bytes>(apart);
  }
  [[nodiscard]] std::size_t start_of(std::size_t slot) const { return static_cast<std::size_t>(starts_[slot]); }
  /// Chooses the cell size. Returns the total number of cells that the boxes cover.
  std::size_t choose_cells();

  static constexpr int cells_per_axis = 1 << 20;

  std::span<const Box> boxes_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero(), extent_ = origin_;
  double inverse_size_ = 1;
  Cell count_;
  unsigned shift_ = 63;
  std::vector<Cell> lows_, highs_;  // cells of the lowest and highest corner of each box
  std::vector<int> starts_;         // first entry of each slot
  std::vector<Entry> entries_;
  std::vector<int> places_, ends_;             // entry numbers sorted by box; ends of each box's range, after a 0
  std::array<std::vector<float>, 6> rounded_;  // boxes of the entries, padded for reads in blocks
};

/// Bounding-volume tree of boxes for proximity queries. When the boxes move, the tree is refitted and keeps its
/// structure.
class TriangleTree {
 public:
  /// Builds the tree: splits the boxes in halves along the longest side, down to small leaves.
  void build(std::span<const Box> boxes, int leaf_size = 4);
  /// Updates the positions of the same boxes.
  void refit(std::span<const Box> boxes);

  /// Returns the box around all boxes; without boxes it is empty.
  [[nodiscard]] const Box& bounds() const { return nodes_.front().box; }

  /// Calls visit(k) for every box k that overlaps the given one, and for some others.
  template <class Visit>
  void for_overlapping(const Box& box, Visit&& visit) const {
    for (std::size_t n = 0; n < nodes_.size();) {
      const Node& node = nodes_[n];
      if (!node.box.intersects(box)) {
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
    stack[height++] = {0, nodes_.front().box.squaredExteriorDistance(point)};
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
      Waiting near{left, nodes_[left].box.squaredExteriorDistance(point)};
      Waiting far{right, nodes_[right].box.squaredExteriorDistance(point)};
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

  std::vector<Node> nodes_;
  std::vector<int> order_;
};

}  // namespace drape
