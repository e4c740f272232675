#include "sim/collision/spatial_index.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace drape {
namespace {

constexpr double most_cells_per_box = 12;
// In mean box sizes. Comparing many boxes in a cell at once is cheaper than storing each in many cells.
constexpr double cell_size = 2;

}  // namespace

void SpatialHash::build(std::span<const Box> boxes) {
  boxes_ = boxes;
  starts_.clear();
  if (boxes.empty()) return;
  const std::size_t wanted = choose_cells();
  std::size_t slots = 2;
  shift_ = 63;
  while (slots < wanted) {
    slots *= 2;
    --shift_;
  }

  // Counting sort: entries of a slot stay in the order of the boxes.
  starts_.assign(slots + 1, 0);
  entries_.resize(wanted);
  const auto for_entries = [&](auto&& visit) {
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const Cell low = lows_[k], high = highs_[k];
      Cell c;
      for (c.z = low.z; c.z <= high.z; ++c.z) {
        for (c.y = low.y; c.y <= high.y; ++c.y) {
          for (c.x = low.x; c.x <= high.x; ++c.x) visit(Entry{key_of(c), static_cast<int>(k)});
        }
      }
    }
  };
  for_entries([&](const Entry& entry) { ++starts_[slot_of(entry.key) + 1]; });
  for (std::size_t s = 1; s < starts_.size(); ++s) starts_[s] += starts_[s - 1];
  places_.resize(wanted);
  ends_.resize(boxes.size() + 1);
  int count = 0;
  for_entries([&](const Entry& entry) {
    const int place = starts_[slot_of(entry.key)]++;
    entries_[static_cast<std::size_t>(place)] = entry;
    places_[static_cast<std::size_t>(count)] = place;
    ends_[static_cast<std::size_t>(entry.box) + 1] = ++count;
  });
  // The loop advanced every start to that of the next slot.
  std::copy_backward(starts_.begin(), starts_.end() - 1, starts_.end());
  starts_.front() = 0;

  for (auto& values : rounded_) values.resize(wanted + at_once);
  for (std::size_t e = 0; e < wanted; ++e) {
    const Rounded rounded = round(boxes[static_cast<std::size_t>(entries_[e].box)]);
    for (std::size_t k = 0; k < rounded.size(); ++k) rounded_[k][e] = rounded[k];
  }
}

std::size_t SpatialHash::choose_cells() {
  Box all = boxes_.front();
  double sum = 0;
  for (const Box& box : boxes_) {
    all.extend(box);
    sum += box.sizes().maxCoeff();
  }
  origin_ = all.min();
  extent_ = all.sizes();
  const auto count = static_cast<double>(boxes_.size());
  lows_.resize(boxes_.size());
  highs_.resize(boxes_.size());
  for (double size = std::max({cell_size * sum / count, 2 * extent_.maxCoeff() / cells_per_axis, 1e-300});;
       size *= 1.5) {
    inverse_size_ = 1 / size;
    double entries = 0;
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      const Cell low = lows_[k] = cell_of(boxes_[k].min()), high = highs_[k] = cell_of(boxes_[k].max());
      entries += (high.x - low.x + 1.0) * (high.y - low.y + 1.0) * (high.z - low.z + 1.0);
    }
    if (entries > most_cells_per_box * count) continue;
    const Cell last = cell_of(all.max());
    count_ = {last.x + 1, last.y + 1, last.z + 1};
    return static_cast<std::size_t>(entries);
  }
}

void TriangleTree::build(std::span<const Box> boxes, int leaf_size) {
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.clear();
  split(boxes, 0, static_cast<int>(boxes.size()), leaf_size);
  refit(boxes);
}

void TriangleTree::split(std::span<const Box> boxes, int first, int count, int leaf_size) {
  const std::size_t node = nodes_.size();
  const bool leaf = count <= leaf_size;
  nodes_.push_back({Box(), 0, first, leaf ? count : 0});
  if (!leaf) {
    const auto middle_of = [&](int k) { return boxes[static_cast<std::size_t>(k)].center(); };
    const auto begin = order_.begin() + first, end = begin + count;
    Box middles;
    for (auto k = begin; k != end; ++k) middles.extend(middle_of(*k));
    Eigen::Index axis = 0;
    middles.sizes().maxCoeff(&axis);
    const int half = count / 2;
    std::nth_element(begin, begin + half, end,
                     [&](int k, int l) { return std::pair(middle_of(k)[axis], k) < std::pair(middle_of(l)[axis], l); });
    split(boxes, first, half, leaf_size);
    split(boxes, first + half, count - half, leaf_size);
  }
  nodes_[node].skip = nodes_.size();
}

void TriangleTree::refit(std::span<const Box> boxes) {
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    node.box.setEmpty();
    for (int k = node.first; k < node.first + node.count; ++k) {
      node.box.extend(boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]);
    }
    if (node.count > 0 || node.skip == n + 1) continue;
    const std::size_t left = n + 1, right = nodes_[left].skip;
    node.box.extend(nodes_[left].box).extend(nodes_[right].box);
  }
}

}  // namespace drape
