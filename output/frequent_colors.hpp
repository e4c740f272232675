#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/image.hpp"

namespace drape {

/// Finds the colours that cover much of a film, in constant memory.
///
/// Counts with a fixed number k of counters (Misra & Gries, "Finding repeated elements", 1982): a colour without a
/// counter takes a free one, or else lowers all of them. A counter is too low by at most the (k+1)-th part of all
/// pixels, and never too high.
class FrequentColors {
 public:
  void add(const Image& image);

  /// The colours, 0xRRGGBB in ascending order, of all those that cover more than 5 % of the pixels added, and of none
  /// that covers less than 1 %.
  [[nodiscard]] std::vector<std::uint32_t> colors() const;

 private:
  struct Counter {
    std::uint32_t color = 0;
    std::uint64_t count = 0;  // 0: free
  };

  void add_run(std::uint32_t color, std::uint64_t length);

  static constexpr std::size_t counter_count = 32;
  std::array<Counter, counter_count> counters_{};
  std::uint64_t total_ = 0;
};

}  // namespace drape
