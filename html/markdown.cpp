#include "html/markdown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/text.hpp"

namespace drape {

std::string markdown(std::string_view text) {
  constexpr std::string_view signs = "\\`*_[]<>|&$~";
  const std::string shown = escape_controls(text);
  std::string escaped;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const char c = shown[i];
    // GitHub shows :name: as a picture.
    const bool picture =
        c == ':' && i + 1 < shown.size() && std::isgraph(static_cast<unsigned char>(shown[i + 1])) != 0;
    if (signs.find(c) != std::string_view::npos || picture) escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

std::string markdown_code(std::string_view text) {
  const std::string code = shown(text);
  std::size_t longest = 0, run = 0;
  for (const char c : code) {
    run = c == '`' ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  // The fence is longer than every run of backticks inside; the spaces belong to it (CommonMark, 6.1).
  const std::string fence(longest + 1, '`');
  return longest == 0 ? fence + code + fence : fence + " " + code + " " + fence;
}

std::string link_target(std::string_view file) {
  constexpr std::string_view unreserved = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~";
  std::string target;
  for (const char c : file) {
    if (unreserved.find(c) != std::string_view::npos) {
      target += c;
    } else {
      target += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return target;
}

}  // namespace drape
