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

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace drape
