#include "sim/collision/spatial_hash.hpp"

#include <algorithm>
#include <cmath>

namespace drape {
namespace {

constexpr double most_cells_per_box = 12;

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

  // A counting sort: the entries of a slot are in the order of the boxes, whatever the hash.
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
  for_entries([&](const Entry& entry) { entries_[static_cast<std::size_t>(starts_[slot_of(entry.key)]++)] = entry; });
  // Every start has moved to the next slot's.
  std::copy_backward(starts_.begin(), starts_.end() - 1, starts_.end());
  starts_.front() = 0;
}

std::size_t SpatialHash::choose_cells() {
  Box all = boxes_.front();
  double sum = 0;
  for (const Box& box : boxes_) {
    all.low = all.low.cwiseMin(box.low);
    all.high = all.high.cwiseMax(box.high);
    sum += (box.high - box.low).maxCoeff();
  }
  origin_ = all.low;
  extent_ = all.high - all.low;
  const auto count = static_cast<double>(boxes_.size());
  lows_.resize(boxes_.size());
  highs_.resize(boxes_.size());
  for (double size = std::max({sum / count, 2 * extent_.maxCoeff() / cells_per_axis, 1e-300});; size *= 1.5) {
    inverse_size_ = 1 / size;
    double entries = 0;
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      const Cell low = lows_[k] = cell_of(boxes_[k].low), high = highs_[k] = cell_of(boxes_[k].high);
      entries += (high.x - low.x + 1.0) * (high.y - low.y + 1.0) * (high.z - low.z + 1.0);
    }
    if (entries > most_cells_per_box * count) continue;
    const Cell last = cell_of(all.high);
    count_ = {last.x + 1, last.y + 1, last.z + 1};
    return static_cast<std::size_t>(entries);
  }
}

void SpatialHash::gather(std::size_t begin, std::size_t end) {
  for (auto& values : gathered_) values.resize(std::max(values.size(), end - begin));
  overlap_.resize(gathered_[0].size());
  // Relative to the origin, so that rounding is a small part of the boxes' size.
  const float margin = static_cast<float>(extent_.maxCoeff()) * 1e-6F;
  for (std::size_t e = begin; e < end; ++e) {
    const Box& box = boxes_[static_cast<std::size_t>(entries_[e].box)];
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      gathered_[a][e - begin] = static_cast<float>(box.low[axis] - origin_[axis]) - margin;
      gathered_[a + 3][e - begin] = static_cast<float>(box.high[axis] - origin_[axis]) + margin;
    }
  }
}

void SpatialHash::compare(std::size_t first, std::size_t count) {
  const float *lx = gathered_[0].data(), *ly = gathered_[1].data(), *lz = gathered_[2].data();
  const float *hx = gathered_[3].data(), *hy = gathered_[4].data(), *hz = gathered_[5].data();
  const float ax = lx[first], ay = ly[first], az = lz[first], bx = hx[first], by = hy[first], bz = hz[first];
  unsigned char* overlap = overlap_.data();
  for (std::size_t k = first + 1; k < count; ++k) {
    const int apart = static_cast<int>(lx[k] > bx) | static_cast<int>(ly[k] > by) | static_cast<int>(lz[k] > bz) |
                      static_cast<int>(hx[k] < ax) | static_cast<int>(hy[k] < ay) | static_cast<int>(hz[k] < az);
    overlap[k] = static_cast<unsigned char>(apart == 0);
  }
}

}  // namespace drape
