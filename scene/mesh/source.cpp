#include "scene/mesh/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/read_file.hpp"
#include "core/text.hpp"

namespace drape {
namespace {

/// Whether a byte is not the first of a character in UTF-8.
bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Refuses what is no text, but would be one if it were exported again.
void require_no_binary_usd(const std::filesystem::path& file, const std::string& bytes) {
  const auto fail = [&](const char* form) {
    throw UsageError(fmt::format("{}: this is a {}; export it as ASCII, with the ending .usda", shown(file), form));
  };
  if (bytes.starts_with("PXR-USDC")) fail("binary USD file (usdc)");
  if (bytes.starts_with("PK\x03\x04")) fail("packed USD file (usdz)");
}

}  // namespace

SourceText SourceText::read(const std::filesystem::path& file) {
  // A grid of four million cells, the largest there is, takes about half a gigabyte as text.
  constexpr std::size_t most_bytes = 2'000'000'000;
  std::string bytes = read_file(file, most_bytes);
  require_no_binary_usd(file, bytes);
  return {file.string(), text_of(file, std::move(bytes))};
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
    if (!continues_character(text_[i])) ++column;
  }
  throw UsageError(fmt::format("{}:{}:{}: {}", shown(name_), line(offset), column, message));
}

void SourceText::fail(const std::string& message) const { throw UsageError(shown(name_) + ": " + message); }

std::string in_quotes(std::string_view piece) {
  constexpr std::size_t longest = 40;
  std::size_t cut = std::min({piece.find('\n'), longest, piece.size()});
  while (cut > 0 && cut < piece.size() && continues_character(piece[cut])) --cut;
  return '\'' + escape_controls(piece.substr(0, cut)) + (cut < piece.size() ? "…'" : "'");
}

}  // namespace drape
