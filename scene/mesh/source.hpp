#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core/read_file.hpp"

namespace drape {

/// The text of a mesh file and its name in messages. Readers use byte offsets; line and column are computed only for
/// messages.
class SourceText {
 public:
  SourceText(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {}

  /// @throws UsageError if the file cannot be read
  static SourceText read(const std::filesystem::path& file);

  /// Opens a text of any size that stays in its file: piece() reads it, and text() is empty. A pipe is read whole.
  /// @throws UsageError if the file cannot be read
  static SourceText open(const std::filesystem::path& file);

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Returns the whole text if it is in memory.
  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] bool stays_in_file() const { return file_ != nullptr; }

  /// Returns the text from an offset on; empty at the end. A text in memory is returned to its end, otherwise a piece
  /// of at most `piece_bytes`.
  /// @param memory storage for the piece
  /// @throws UsageError if the file cannot be read, or is not text
  [[nodiscard]] std::string_view piece(std::size_t offset, std::string& memory) const;
  static constexpr std::size_t piece_bytes = 1 << 16;

  /// Returns the line of an offset, from 1.
  [[nodiscard]] std::size_t line(std::size_t offset) const;

  /// Throws a message with a place. Lines and columns count from 1; columns count UTF-8 characters.
  /// @throws UsageError "name:line:column: message"
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const;

  /// @throws UsageError "name: message"
  [[noreturn]] void fail(const std::string& message) const;

 private:
  [[nodiscard]] std::pair<std::size_t, std::size_t> line_and_column(std::size_t offset) const;

  std::string name_;
  std::string text_;
  std::shared_ptr<const FilePieces> file_ = {};  // null: the text is in memory
  std::size_t begin_ = 0;                        // start of the text in the file, after a byte-order mark
};

/// A place in a file, for messages.
struct SourcePlace {
  const SourceText* source = nullptr;  ///< must outlive this object
  std::size_t offset = 0;

  /// @throws UsageError, as SourceText::fail
  [[noreturn]] void fail(const std::string& message) const { source->fail(offset, message); }
};

/// Quotes a piece of a file for a message: cut if long or at the end of the line, without control characters.
std::string in_quotes(std::string_view piece);

}  // namespace drape
