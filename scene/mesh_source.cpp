#include "scene/mesh_source.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/error.hpp"

namespace drape {

SourceText SourceText::read(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) throw UsageError(name + ": this is a folder, not a file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw UsageError(name +
                     (std::filesystem::exists(file, ignored) ? ": the file cannot be opened" : ": no such file"));
  }
  std::ostringstream text;
  // An empty file sets failbit on `text`; what counts is whether reading failed.
  text << stream.rdbuf();
  if (stream.bad()) throw UsageError(name + ": the file cannot be read");
  return {name, std::move(text).str()};
}

std::size_t SourceText::line(std::size_t offset) const {
  const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text_.size()));
  return 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
}

void SourceText::fail(std::size_t offset, const std::string& message) const {
  offset = std::min(offset, text_.size());
  const std::size_t newline = offset == 0 ? std::string::npos : text_.rfind('\n', offset - 1);
  std::size_t column = 1;
  for (std::size_t i = newline == std::string::npos ? 0 : newline + 1; i < offset; ++i) {
    const bool continues_a_character = (static_cast<unsigned char>(text_[i]) & 0xC0U) == 0x80U;
    if (!continues_a_character) ++column;
  }
  throw UsageError(fmt::format("{}:{}:{}: {}", name_, line(offset), column, message));
}

void SourceText::fail(const std::string& message) const { throw UsageError(name_ + ": " + message); }

std::string in_quotes(std::string_view piece) {
  constexpr std::size_t kLongest = 40;
  std::string result = "'";
  for (const char c : piece.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) {
      result += fmt::format("\\x{:02x}", byte);
    } else {
      result += c;
    }
  }
  return result + (piece.size() > kLongest ? "…'" : "'");
}

}  // namespace drape
