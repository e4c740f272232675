#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace drape {

/// A box with its sides along the axes [m].
struct Box {
  Eigen::Vector3d low, high;

  [[nodiscard]] bool overlaps(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

/// Boxes sorted by the cells of a uniform grid that they reach into, for finding those that overlap in nearly linear
/// time (Teschner et al. 2003, "Optimized spatial hashing for collision detection of deformable objects"). The cells
/// are as large as the boxes on average, or larger where a few huge ones would fill too many.
/// Every overlapping pair is visited once: in the cell of the lowest corner of what the two have in common.
class SpatialHash {
 public:
  /// Replaces the boxes. Keeps its memory. The boxes have to outlive the visits.
  void build(std::span<const Box> boxes);

  /// Calls visit(k) for every box k that overlaps the given one.
  template <class Visit>
  void for_overlapping(const Box& box, Visit&& visit) const {
    if (boxes_.empty()) return;
    const Cell low = cell_of(box.low), high = cell_of(box.high);
    Cell cell;
    for (cell.z = std::max(low.z, 0); cell.z <= std::min(high.z, count_.z - 1); ++cell.z) {
      for (cell.y = std::max(low.y, 0); cell.y <= std::min(high.y, count_.y - 1); ++cell.y) {
        for (cell.x = std::max(low.x, 0); cell.x <= std::min(high.x, count_.x - 1); ++cell.x) {
          const std::uint64_t key = key_of(cell);
          const std::size_t slot = slot_of(key);
          for (int e = starts_[slot]; e < starts_[slot + 1]; ++e) {
            const Entry& entry = entries_[static_cast<std::size_t>(e)];
            const Box& other = boxes_[static_cast<std::size_t>(entry.box)];
            if (entry.key == key && box.overlaps(other) && is_first(cell, box, other)) visit(entry.box);
          }
        }
      }
    }
  }

  /// Calls visit(k, l), k < l, for every two boxes that overlap.
  template <class Visit>
  void for_pairs(Visit&& visit) const {
    for (std::size_t slot = 0; slot + 1 < starts_.size(); ++slot) {
      for (int e = starts_[slot]; e < starts_[slot + 1]; ++e) {
        const Entry& first = entries_[static_cast<std::size_t>(e)];
        const Box& box = boxes_[static_cast<std::size_t>(first.box)];
        for (int f = e + 1; f < starts_[slot + 1]; ++f) {
          const Entry& second = entries_[static_cast<std::size_t>(f)];
          if (second.key != first.key || second.box == first.box) continue;
          const Box& other = boxes_[static_cast<std::size_t>(second.box)];
          if (box.overlaps(other) && is_first(first.cell, box, other)) visit(first.box, second.box);
        }
      }
    }
  }

 private:
  struct Cell {
    int x = 0, y = 0, z = 0;
  };
  /// A box in a cell.
  struct Entry {
    std::uint64_t key;
    Cell cell;
    int box;
  };

  [[nodiscard]] Cell cell_of(const Eigen::Vector3d& place) const {
    const Eigen::Vector3d p = ((place - origin_) / size_).cwiseMax(-1.0).cwiseMin(cells_per_axis);
    return {static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())),
            static_cast<int>(std::floor(p.z()))};
  }
  static std::uint64_t key_of(const Cell& c) {
    return static_cast<std::uint64_t>(c.x) | static_cast<std::uint64_t>(c.y) << 21U |
           static_cast<std::uint64_t>(c.z) << 42U;
  }
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const {
    return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15U) >> shift_);  // Fibonacci hashing (Knuth, section 6.4)
  }
  /// Whether a cell is that of the lowest corner of two boxes' intersection.
  [[nodiscard]] bool is_first(const Cell& cell, const Box& a, const Box& b) const {
    const Cell first = cell_of(a.low.cwiseMax(b.low));
    return first.x == cell.x && first.y == cell.y && first.z == cell.z;
  }
  /// How many cells the boxes reach into in all.
  [[nodiscard]] double entries() const;
  void choose_cells();

  static constexpr double cells_per_axis = 1 << 20;

  std::span<const Box> boxes_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero(), extent_ = origin_;
  double size_ = 1;
  Cell count_;
  unsigned shift_ = 63;
  std::vector<int> starts_;  // of each slot's entries
  std::vector<Entry> entries_;
};

}  // namespace drape
