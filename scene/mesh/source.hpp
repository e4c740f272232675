#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core/read_file.hpp"

namespace drape {

/// The text of a mesh file and the name it goes by in messages. Readers work with byte offsets into it; the line and
/// the column are counted only when there is something to complain about.
class SourceText {
 public:
  SourceText(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {}

  /// @throws UsageError if the file cannot be read
  static SourceText read(const std::filesystem::path& file);

  /// A text of any size that stays in its file: piece() reads it, and text() is empty. A pipe is read whole.
  /// @throws UsageError if the file cannot be read
  static SourceText open(const std::filesystem::path& file);

  [[nodiscard]] const std::string& name() const { return name_; }
  /// All of it, if it is in memory.
  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] bool stays_in_file() const { return file_ != nullptr; }

  /// The text from an offset on, empty at its end: all that follows if it is in memory, else a piece of at most
  /// `piece_bytes`.
  /// @param memory for the piece
  /// @throws UsageError if the file cannot be read, or is no text
  [[nodiscard]] std::string_view piece(std::size_t offset, std::string& memory) const;
  static constexpr std::size_t piece_bytes = 1 << 16;

  /// The line of an offset, from 1.
  [[nodiscard]] std::size_t line(std::size_t offset) const;

  /// @throws UsageError "name:line:column: message"; lines and columns count from 1, and columns count characters of
  /// UTF-8
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const;

  /// @throws UsageError "name: message"
  [[noreturn]] void fail(const std::string& message) const;

 private:
  [[nodiscard]] std::pair<std::size_t, std::size_t> line_and_column(std::size_t offset) const;

  std::string name_;
  std::string text_;
  std::shared_ptr<const FilePieces> file_ = {};  // null: the text is in memory
  std::size_t begin_ = 0;                        // of the text in the file: behind a byte-order mark
};

/// A place in a file, for a message about what stands there.
struct SourcePlace {
  const SourceText* source = nullptr;  ///< outlives this
  std::size_t offset = 0;

  /// @throws UsageError, as SourceText::fail
  [[noreturn]] void fail(const std::string& message) const { source->fail(offset, message); }
};

/// A piece of a file between single quotes, for a message: cut where it is long or ends its line, without control
/// characters.
std::string in_quotes(std::string_view piece);

}  // namespace drape
