#include "scene/mesh/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/read_file.hpp"
#include "core/text.hpp"

namespace drape {
namespace {

/// Returns true for a continuation byte of UTF-8.
bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Rejects binary USD with a hint to export it as ASCII.
void require_no_binary_usd(const std::filesystem::path& file, const std::string& bytes) {
  const auto fail = [&](const char* form) {
    throw UsageError(fmt::format("{}: this is a {}; export it as ASCII, with the ending .usda", shown(file), form));
  };
  if (bytes.starts_with("PXR-USDC")) fail("binary USD file (usdc)");
  if (bytes.starts_with("PK\x03\x04")) fail("packed USD file (usdz)");
}

}  // namespace

SourceText SourceText::read(const std::filesystem::path& file) {
  // A grid of four million cells, the largest allowed, takes about half a gigabyte as text.
  constexpr std::size_t most_bytes = 2'000'000'000;
  std::string bytes = read_file(file, most_bytes);
  require_no_binary_usd(file, bytes);
  return {file.string(), text_of(file, std::move(bytes))};
}

SourceText SourceText::open(const std::filesystem::path& file) {
  if (!FilePieces::possible(file)) return read(file);
  SourceText source(file.string(), {});
  source.file_ = std::make_shared<const FilePieces>(file);
  std::string first;
  source.file_->read(0, piece_bytes, first);
  require_no_binary_usd(file, first);
  source.begin_ = first.size() - text_of(file, first).size();
  return source;
}

std::string_view SourceText::piece(std::size_t offset, std::string& memory) const {
  if (file_ == nullptr) return std::string_view(text_).substr(std::min(offset, text_.size()));
  file_->read(begin_ + offset, piece_bytes, memory);
  if (memory.find('\0') != std::string::npos) text_of(name_, memory);  // throws
  return memory;
}

std::pair<std::size_t, std::size_t> SourceText::line_and_column(std::size_t offset) const {
  std::size_t line = 1, column = 1, at = 0;
  std::string memory;
  while (at < offset) {
    const std::string_view text = piece(at, memory).substr(0, offset - at);
    if (text.empty()) break;
    at += text.size();
    for (const char c : text) {
      if (c == '\n') {
        ++line;
        column = 1;
      } else if (!continues_character(c)) {
        ++column;
      }
    }
  }
  return {line, column};
}

std::size_t SourceText::line(std::size_t offset) const { return line_and_column(offset).first; }

void SourceText::fail(std::size_t offset, const std::string& message) const {
  const auto [line, column] = line_and_column(offset);
  throw UsageError(fmt::format("{}:{}:{}: {}", shown(name_), line, column, message));
}

void SourceText::fail(const std::string& message) const { throw UsageError(shown(name_) + ": " + message); }

std::string in_quotes(std::string_view piece) {
  constexpr std::size_t longest = 40;
  std::size_t cut = std::min({piece.find('\n'), longest, piece.size()});
  while (cut > 0 && cut < piece.size() && continues_character(piece[cut])) --cut;
  return '\'' + escape_controls(piece.substr(0, cut)) + (cut < piece.size() ? "…'" : "'");
}

}  // namespace drape
