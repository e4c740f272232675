#include "run/shard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>

#include "core/error.hpp"

namespace drape {

std::string Shard::text() const { return fmt::format("{}/{}", number, count); }

Shard parse_shard(const std::string& text) {
  constexpr std::size_t most = 100'000;
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  const bool two = number.ec == std::errc() && number.ptr != end && *number.ptr == '/';
  const auto count = two ? std::from_chars(number.ptr + 1, end, shard.count) : number;
  if (!two || count.ec != std::errc() || count.ptr != end || shard.number < 1 || shard.number > shard.count ||
      shard.count > most) {
    throw UsageError(fmt::format("--shard takes K/N, the K-th of N parts, as in 2/5; found '{}'", text));
  }
  return shard;
}

std::vector<std::size_t> runs_of_shard(const std::vector<double>& costs, const Shard& shard) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
  std::vector<double> loads(shard.count, 0);
  std::vector<std::size_t> mine;
  for (const std::size_t run : order) {
    const auto least = std::min_element(loads.begin(), loads.end());
    *least += costs[run];
    if (static_cast<std::size_t>(least - loads.begin()) + 1 == shard.number) mine.push_back(run);
  }
  std::sort(mine.begin(), mine.end());
  return mine;
}

}  // namespace drape
