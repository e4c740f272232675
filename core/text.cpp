#include "core/text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace drape {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

struct Character {
  std::size_t length = 0;  // [bytes]; 0: invalid UTF-8 (RFC 3629)
  std::uint32_t code = 0;
};

/// Decodes the first character of a text.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return {1, first};
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || length > text.size()) return {};
  std::uint32_t code = first & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = code << 6 | (byte(i) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < smallest[length] || code > 0x10FFFF || surrogate ? Character{} : Character{length, code};
}

/// Returns true for invisible characters that end lines or change the direction of writing (Unicode, annex 9).
bool is_unseen(std::uint32_t code) {
  return code == 0x061C || code == 0x200E || code == 0x200F || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}

bool is_control(std::uint32_t code) { return code < 0x20 || (code >= 0x7F && code < 0xA0); }

bool is_printable(const Character& c) {
  if (c.length == 0 || is_unseen(c.code) || (c.code & 0xFFFEU) == 0xFFFE) return false;
  return c.code == '\n' || c.code == '\t' || !is_control(c.code);
}

/// Returns true if a build server may take this position for a command: GitHub "::" at the start of a line and "##[",
/// Azure "##vso[".
bool is_command(std::string_view text, std::size_t at) {
  const std::string_view here = text.substr(at);
  if (here.starts_with("##[") || here.starts_with("##vso[")) return true;
  if (!here.starts_with("::")) return false;
  const std::size_t last = text.substr(0, at).find_last_not_of(" \t");
  return last == std::string_view::npos || text[last] == '\n';
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Character c = first_character(text);
    const std::size_t length = std::max<std::size_t>(c.length, 1);
    result += is_printable(c) ? text.substr(0, length) : replacement;
    if (!is_printable(c) && c.length > 1) {
      for (std::size_t i = 1; i < c.length; ++i) result += replacement;  // one for each byte
    }
    text.remove_prefix(length);
  }
  return result;
}

std::string escape_controls(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const Character c = first_character(text.substr(at));
    const auto byte = static_cast<unsigned char>(text[at]);
    if (c.length == 0 || is_command(text, at) || (is_control(c.code) && c.code != '\n')) {
      result += fmt::format("\\x{:02x}", c.length == 0 ? byte : c.code);
    } else if (is_unseen(c.code)) {
      result += fmt::format("\\u{:04x}", c.code);
    } else {
      result += text.substr(at, c.length);
    }
    at += std::max<std::size_t>(c.length, 1);
  }
  return result;
}

std::string shown(std::string_view name) {
  std::string result = escape_controls(name);
  for (std::size_t at = 0; (at = result.find('\n', at)) != std::string::npos;) result.replace(at, 1, "\\x0a");
  return result;
}

std::string shown(const std::filesystem::path& file) { return shown(std::string_view(file.native())); }

std::string readable_length(double metres) {
  if (metres == 0) return "0";
  if (!std::isfinite(metres)) return "not finite";
  struct Unit {
    const char* name;
    double size, least;  // [m]
  };
  constexpr std::array<Unit, 3> units{{{"m", 1, 1}, {"mm", 1e-3, 1e-4}, {"µm", 1e-6, 1e-6}}};
  constexpr double rounds_up = 0.9995;  // to 1 with three digits
  for (const auto& [name, size, least] : units) {
    if (std::abs(metres) >= rounds_up * least) return fmt::format("{:.3g} {}", metres / size, name);
  }
  return fmt::format("{:.3g} nm", 1e9 * metres);
}

std::string readable_time(double seconds, double spacing) {
  constexpr double rounding = 1e-9;  // of the logarithm of a power of ten
  const double digits = std::clamp(std::ceil(-std::log10(spacing) - rounding), 2.0, 15.0);
  return fmt::format("{:.{}f} s", seconds, static_cast<int>(digits));
}

namespace {

constexpr std::size_t least_room = 20;      // columns that must remain after the indent
constexpr std::size_t description_at = 30;  // column of CLI11's descriptions

std::size_t indent_of(std::string_view line) {
  const std::size_t first = line.find_first_not_of(' ');
  return first == std::string_view::npos ? 0 : first;
}

std::string wrapped_line(std::string_view line, std::size_t width, std::size_t indent) {
  if (columns_of(line) <= width || width < indent + least_room) return std::string(line);
  const std::size_t begin = indent_of(line);
  std::string text(begin, ' ');
  std::size_t used = begin;
  bool at_start = true;  // of a line of the result
  for (std::size_t at = begin; at < line.size();) {
    // A word with the spaces before it; they are dropped only where the line is broken.
    const std::size_t word = std::min(line.find_first_not_of(' ', at), line.size());
    const std::size_t end = std::min(line.find(' ', word), line.size());
    const std::string_view spaces = line.substr(at, word - at), letters = line.substr(word, end - word);
    if (!at_start && used + spaces.size() + columns_of(letters) > width) {
      text.append("\n").append(indent, ' ').append(letters);
      used = indent + columns_of(letters);
    } else {
      text.append(spaces).append(letters);
      used += spaces.size() + columns_of(letters);
    }
    at_start = false;
    at = end;
  }
  return text;
}

template <class Indent>
std::string wrapped_lines(std::string_view text, std::size_t width, Indent indent) {
  if (width == unlimited_width) return std::string(text);
  std::string result;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    result += wrapped_line(line, width, indent(line));
    if (end < text.size()) result += '\n';
    begin = end + 1;
  }
  return result;
}

}  // namespace

std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }));
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t hanging) {
  return wrapped_lines(text, width, [hanging](std::string_view line) { return indent_of(line) + hanging; });
}

std::string wrapped_help(std::string_view text, std::size_t width) {
  return wrapped_lines(text, width, [](std::string_view line) {
    const bool described = line.size() > description_at && indent_of(line) > 0 && line[description_at - 1] == ' ' &&
                           line[description_at] != ' ';
    return described ? description_at : indent_of(line) + 2;
  });
}

namespace {

std::string folded(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == '-' || c == ' ') c = '_';
  }
  return result;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, substituted});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string nearest_name(std::string_view name, std::span<const std::string> names) {
  // Names are short: for a longer text the quadratic distance would only cost time.
  constexpr std::size_t longest_name = 64;
  if (name.size() > longest_name) return {};

  const std::string wanted = folded(name);
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : names) {
    const std::size_t distance = edit_distance(wanted, folded(candidate));
    if (distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string did_you_mean(std::string_view name, std::span<const std::string> names, std::string_view kind) {
  const std::string nearest = nearest_name(name, names);
  if (!nearest.empty()) return "; did you mean '" + nearest + "'?";
  return names.empty() ? "" : "; " + std::string(kind) + " " + quoted_list(names);
}

std::string quoted_list(std::span<const std::string> names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "'" : ", '") + name + "'";
  return list;
}

}  // namespace drape
