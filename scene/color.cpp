#include "scene/color.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <vector>

namespace drape {
namespace {

struct NamedColor {
  const char* name;
  std::uint32_t rgb;
};

// CSS Color Module Level 4, section 6.1.
constexpr NamedColor named_colors[] = {
    {"white", 0xffffff},  {"silver", 0xc0c0c0}, {"gray", 0x808080},  {"black", 0x000000}, {"red", 0xff0000},
    {"maroon", 0x800000}, {"yellow", 0xffff00}, {"olive", 0x808000}, {"lime", 0x00ff00},  {"green", 0x008000},
    {"aqua", 0x00ffff},   {"teal", 0x008080},   {"blue", 0x0000ff},  {"navy", 0x000080},  {"fuchsia", 0xff00ff},
    {"purple", 0x800080}, {"orange", 0xffa500},
};

Rgb unpack(std::uint32_t rgb) {
  const auto channel = [rgb](int shift) { return static_cast<double>((rgb >> shift) & 0xff) / 255; };
  return {channel(16), channel(8), channel(0)};
}

}  // namespace

std::span<const std::string> color_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const NamedColor& color : named_colors) list.emplace_back(color.name);
    return list;
  }();
  return names;
}

std::optional<Rgb> parse_color(std::string_view text) {
  for (const auto& [name, rgb] : named_colors) {
    if (text == name) return unpack(rgb);
  }
  if (text.empty() || text.front() != '#') return std::nullopt;
  std::string digits(text.substr(1));
  if (digits.size() == 3) digits = {digits[0], digits[0], digits[1], digits[1], digits[2], digits[2]};
  if (digits.size() != 6) return std::nullopt;
  std::uint32_t rgb = 0;
  const char* const end = digits.data() + digits.size();
  if (std::from_chars(digits.data(), end, rgb, 16).ptr != end) return std::nullopt;
  return unpack(rgb);
}

std::string color_text(const Rgb& color) {
  const auto channel = [](double value) { return static_cast<int>(std::lround(value * 255)); };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(color.r), channel(color.g), channel(color.b));
}

}  // namespace drape
