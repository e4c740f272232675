#include "cli/line_option.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/text.hpp"

namespace drape {

CLI::Validator on_one_line() {
  const auto problem = [](const std::string& text) -> std::string {
    const bool plain = std::ranges::none_of(text, [](unsigned char c) { return c < 0x20 || c == 0x7F; });
    return plain ? "" : fmt::format("expected a text without control characters, found '{}'", shown(text));
  };
  return CLI::Validator(problem, "");
}

}  // namespace drape
