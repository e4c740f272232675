#include "sim/collision/spatial_hash.hpp"

#include <algorithm>
#include <cmath>

namespace drape {
namespace {

constexpr double most_cells_per_box = 12;

}  // namespace

void SpatialHash::build(std::span<const Box> boxes) {
  boxes_ = boxes;
  if (boxes.empty()) return;
  choose_cells();
  const auto wanted = static_cast<std::size_t>(entries());
  std::size_t slots = 2;
  shift_ = 63;
  while (slots < wanted) {
    slots *= 2;
    --shift_;
  }

  // A counting sort: the entries of a slot are in the order of the boxes, whatever the hash.
  starts_.assign(slots + 1, 0);
  entries_.resize(wanted);
  const auto for_entries = [&](auto&& visit) {
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const Cell low = cell_of(boxes[k].low), high = cell_of(boxes[k].high);
      Cell c;
      for (c.z = low.z; c.z <= high.z; ++c.z) {
        for (c.y = low.y; c.y <= high.y; ++c.y) {
          for (c.x = low.x; c.x <= high.x; ++c.x) visit(Entry{key_of(c), c, static_cast<int>(k)});
        }
      }
    }
  };
  for_entries([&](const Entry& entry) { ++starts_[slot_of(entry.key) + 1]; });
  for (std::size_t s = 1; s < starts_.size(); ++s) starts_[s] += starts_[s - 1];
  for_entries([&](const Entry& entry) { entries_[static_cast<std::size_t>(starts_[slot_of(entry.key)]++)] = entry; });
  // Every start has moved to the next slot's.
  std::copy_backward(starts_.begin(), starts_.end() - 1, starts_.end());
  starts_.front() = 0;
}

void SpatialHash::choose_cells() {
  Box all = boxes_.front();
  double sum = 0;
  for (const Box& box : boxes_) {
    all.low = all.low.cwiseMin(box.low);
    all.high = all.high.cwiseMax(box.high);
    sum += (box.high - box.low).maxCoeff();
  }
  origin_ = all.low;
  extent_ = all.high - all.low;
  size_ = std::max({sum / static_cast<double>(boxes_.size()), 2 * extent_.maxCoeff() / cells_per_axis, 1e-300});
  while (entries() > most_cells_per_box * static_cast<double>(boxes_.size())) size_ *= 1.5;
  const Cell last = cell_of(all.high);
  count_ = {last.x + 1, last.y + 1, last.z + 1};
}

double SpatialHash::entries() const {
  double sum = 0;
  for (const Box& box : boxes_) {
    const Cell low = cell_of(box.low), high = cell_of(box.high);
    sum += (high.x - low.x + 1.0) * (high.y - low.y + 1.0) * (high.z - low.z + 1.0);
  }
  return sum;
}

}  // namespace drape
