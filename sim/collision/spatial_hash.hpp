#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
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
            if (entry.key != key || !is_first(cell, low, lows_[static_cast<std::size_t>(entry.box)])) continue;
            if (box.overlaps(boxes_[static_cast<std::size_t>(entry.box)])) visit(entry.box);
          }
        }
      }
    }
  }

  /// Calls visit(k, l), k < l, for every two boxes that overlap.
  template <class Visit>
  void for_pairs(Visit&& visit) {
    for (std::size_t slot = 0; slot + 1 < starts_.size(); ++slot) {
      const auto begin = static_cast<std::size_t>(starts_[slot]), end = static_cast<std::size_t>(starts_[slot + 1]);
      if (end - begin < 2) continue;
      gather(begin, end);
      for (std::size_t e = begin; e + 1 < end; ++e) {
        compare(e - begin, end - begin);
        for (std::size_t f = e + 1; f < end; ++f) {
          if (overlap_[f - begin] == 0) continue;
          const Entry &first = entries_[e], &second = entries_[f];
          const auto k = static_cast<std::size_t>(first.box), l = static_cast<std::size_t>(second.box);
          if (first.key != second.key || k == l || !is_first(cell_at(first.key), lows_[k], lows_[l])) continue;
          if (boxes_[k].overlaps(boxes_[l])) visit(first.box, second.box);
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
    int box;
  };

  [[nodiscard]] Cell cell_of(const Eigen::Vector3d& place) const {
    return {index((place.x() - origin_.x()) * inverse_size_), index((place.y() - origin_.y()) * inverse_size_),
            index((place.z() - origin_.z()) * inverse_size_)};
  }
  /// Rounds down, to −1 and less at −1.
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
  /// Whether a cell is that of the lowest corner of the intersection of two boxes whose lowest corners are in these.
  static bool is_first(const Cell& cell, const Cell& a, const Cell& b) {
    return std::max(a.x, b.x) == cell.x && std::max(a.y, b.y) == cell.y && std::max(a.z, b.z) == cell.z;
  }
  /// Copies the boxes of some entries side by side, in single precision and a little larger.
  void gather(std::size_t begin, std::size_t end);
  /// Sets overlap_ of the gathered boxes behind the first.
  void compare(std::size_t first, std::size_t count);
  /// Chooses their size; returns how many the boxes reach into in all.
  std::size_t choose_cells();

  static constexpr int cells_per_axis = 1 << 20;

  std::span<const Box> boxes_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero(), extent_ = origin_;
  double inverse_size_ = 1;
  Cell count_;
  unsigned shift_ = 63;
  std::vector<Cell> lows_, highs_;  // of the lowest and highest corner of each box
  std::vector<int> starts_;         // of each slot's entries
  std::vector<Entry> entries_;
  std::array<std::vector<float>, 6> gathered_;  // lowest x, y, z, highest x, y, z
  std::vector<unsigned char> overlap_;
};

}  // namespace drape
