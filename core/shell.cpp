#include "core/shell.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace drape {

std::string shell_word(const std::string& word) {
  constexpr std::string_view harmless = "%+,-./:=@_";
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [&](unsigned char c) {
    return std::isalnum(c) != 0 || harmless.find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_file(const std::string& file) { return shell_word(file.starts_with('-') ? "./" + file : file); }

}  // namespace drape
