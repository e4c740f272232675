#include "cli/byte_count.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>

#include "core/error.hpp"

namespace drape {

std::uint64_t parse_byte_count(const std::string& option, const std::string& text) {
  static const std::map<std::string, double> units{{"", 1},         {"B", 1},       {"kB", 1e3},     {"KB", 1e3},
                                                   {"MB", 1e6},     {"GB", 1e9},    {"kiB", 0x1p10}, {"KiB", 0x1p10},
                                                   {"MiB", 0x1p20}, {"GiB", 0x1p30}};
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  const std::string written(rest, end);
  const auto unit = units.find(written.substr(std::min(written.find_first_not_of(' '), written.size())));
  constexpr double largest = 1e18;
  if (error == std::errc() && unit != units.end()) {
    const double bytes = std::floor(number * unit->second);
    if (bytes >= 1 && bytes <= largest) return static_cast<std::uint64_t>(bytes);
  }
  throw UsageError(fmt::format("{} takes a size such as 5MB, 800kB or 1.5GiB; found '{}'", option, text));
}

}  // namespace drape
