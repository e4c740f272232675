#include "output/frequent_colors.hpp"

#include <algorithm>

namespace drape {

void FrequentColors::add(const Image& image) {
  const std::uint8_t* pixel = image.pixels.data();
  const std::size_t count = image.pixels.size() / 3;
  total_ += count;
  std::uint32_t color = 0;
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < count; ++i, pixel += 3) {
    const std::uint32_t next = static_cast<std::uint32_t>(pixel[0] << 16 | pixel[1] << 8 | pixel[2]);
    if (next != color) {
      add_run(color, length);
      color = next;
      length = 0;
    }
    ++length;
  }
  add_run(color, length);
}

void FrequentColors::add_run(std::uint32_t color, std::uint64_t length) {
  const auto same = [color](const Counter& c) { return c.count > 0 && c.color == color; };
  while (length > 0) {
    auto counter = std::find_if(counters_.begin(), counters_.end(), same);
    if (counter == counters_.end()) {
      counter = std::min_element(counters_.begin(), counters_.end(),
                                 [](const Counter& a, const Counter& b) { return a.count < b.count; });
    }
    if (counter->count == 0 || counter->color == color) {
      counter->color = color;
      counter->count += length;
      return;
    }
    const std::uint64_t paid = std::min(length, counter->count);
    for (Counter& c : counters_) c.count -= paid;
    length -= paid;
  }
}

std::vector<std::uint32_t> FrequentColors::colors() const {
  std::vector<std::uint32_t> found;
  for (const Counter& counter : counters_) {
    // With a share of more than 5 %, at least 5 % - 1/33 = 1.97 % are left in the counter.
    if (counter.count > 0 && counter.count * 100 >= total_) found.push_back(counter.color);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace drape
