#include "html/markdown.hpp"

#include <fmt/format.h>

namespace drape {

std::string markdown(std::string_view text) {
  constexpr std::string_view signs = "\\`*_[]<>|&";
  std::string escaped;
  for (const char c : text) {
    if (signs.find(c) != std::string_view::npos) escaped += '\\';
    escaped += c == '\n' || c == '\r' ? ' ' : c;
  }
  return escaped;
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
