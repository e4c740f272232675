#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace drape {

/// Returns the time in drape's comment in a mesh file, "drape: frame 3 at 0.12 s" [s]; nothing unless it is in the
/// first lines.
inline std::optional<double> time_in_comment(std::string_view text) {
  constexpr std::string_view begin = "drape: frame ", at = " at ";
  text = text.substr(0, 400);
  const std::size_t comment = text.find(begin);
  const std::size_t place = comment == std::string_view::npos ? comment : text.find(at, comment);
  if (place == std::string_view::npos) return std::nullopt;
  double time = 0;
  const auto read = std::from_chars(text.data() + place + at.size(), text.data() + text.size(), time);
  return read.ec == std::errc() ? std::optional(time) : std::nullopt;
}

}  // namespace drape
