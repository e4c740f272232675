#include "run/shard.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <numeric>
#include <system_error>

#include "core/text.hpp"
#include "drape/core/error.hpp"

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

namespace {

constexpr const char* shard_prefix = "shard-";

bool is_part(const std::filesystem::path& folder, const char* mark) {
  std::error_code ignored;
  return std::filesystem::exists(folder / mark, ignored);
}

}  // namespace

std::filesystem::path shard_place(const std::filesystem::path& folder, const Shard& shard) {
  return shard.whole() ? folder : folder / fmt::format("{}{}-of-{}", shard_prefix, shard.number, shard.count);
}

std::vector<std::filesystem::path> parts_in(const std::filesystem::path& folder, const char* mark) {
  std::vector<std::filesystem::path> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().filename().string().starts_with(shard_prefix) && is_part(entry.path(), mark)) {
      found.push_back(entry);
    }
  }
  if (error == std::errc::not_a_directory) {
    throw UsageError(fmt::format("{}: this is a file; expected a folder with shards", shown(folder)));
  }
  if (error) throw UsageError(fmt::format("{}: cannot be read: {}", shown(folder), error.message()));
  std::ranges::sort(found);
  if (found.empty() && is_part(folder, mark)) found.push_back(folder);
  return found;
}

bool FoundShards::add(const Shard& shard, const std::filesystem::path& file) {
  if (files_.empty()) count_ = shard.count;
  if (shard.count != count_) fail_as_other(file);
  return files_.try_emplace(shard.number, file).second;
}

void FoundShards::fail_as_other(const std::filesystem::path& file) const {
  throw UsageError(fmt::format("{} and {} are not of one {}", shown(file), shown(files_.begin()->second), whole_));
}

std::vector<Shard> FoundShards::missing() const {
  std::vector<Shard> missing;
  for (std::size_t k = 1; k <= count_; ++k) {
    if (!files_.contains(k)) missing.push_back({k, count_});
  }
  return missing;
}

}  // namespace drape
