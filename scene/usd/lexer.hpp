#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "scene/mesh/source.hpp"

namespace drape {

/// A token of the usda language.
struct UsdToken {
  enum class Kind {
    end,     ///< of the file
    number,  ///< 12, -0.5, 1e-7; inf and nan are words
    word,    ///< a name or keyword, with its namespaces: primvars:st
    string,  ///< "…", '…', """…""" or '''…'''
    asset,   ///< @…@ or @@@…@@@
    path,    ///< <…>
    symbol   ///< one of ( ) [ ] { } = , : ; . &
  };
  Kind kind = Kind::end;
  std::size_t offset = 0;  ///< of its first character
  /// All of it; of strings, what is between the quotes, escapes left as they are. Valid while the lexer is at it or at
  /// the token behind it.
  std::string_view text;
};

/// Splits a usda file into tokens and keeps the one to look at next. Of a text that stays in its file, as much is in
/// memory as the last two tokens need, and a piece.
class UsdLexer {
 public:
  /// Starts at an offset, which must be between tokens.
  UsdLexer(const SourceText& source, std::size_t offset);

  [[nodiscard]] const UsdToken& token() const { return token_; }
  [[nodiscard]] bool at(UsdToken::Kind kind) const { return token_.kind == kind; }
  [[nodiscard]] bool at(char symbol) const { return at(UsdToken::Kind::symbol) && token_.text[0] == symbol; }
  [[nodiscard]] bool at_word(std::string_view word) const { return at(UsdToken::Kind::word) && token_.text == word; }

  /// Returns the token and goes on to the next.
  UsdToken take();

  /// Goes on to the next token if the current one is this symbol.
  bool accept(char symbol);

  /// Goes past a token that must be there. @throws UsageError "expected 'what', found …"
  UsdToken expect(UsdToken::Kind kind, const std::string& what);
  void expect(char symbol, const std::string& what);

  /// Goes past a value of any kind without looking into it; only the brackets must match.
  void skip_value();

  /// Goes past a finite number and returns it; nothing, and stays, if there is none at this token.
  std::optional<double> accept_number();

  /// @throws UsageError "expected what, found …" at the current token
  [[noreturn]] void fail_expected(const std::string& what) const;

 private:
  bool read_more();
  [[nodiscard]] bool at_end() { return next_ == text_.size() && !read_more(); }
  [[nodiscard]] std::size_t here() const { return begin_of_text_ + next_; }
  void find(std::string_view mark, bool keep);
  void skip_blanks_and_comments();
  UsdToken scan();
  UsdToken scan_string(char quote);
  UsdToken scan_asset();
  void skip_brackets();
  [[nodiscard]] char peek(std::size_t ahead = 0) {
    while (next_ + ahead >= text_.size()) {
      if (!read_more()) return '\0';
    }
    return text_[next_ + ahead];
  }

  const SourceText* source_;
  std::string_view text_;             // what is in memory
  std::size_t begin_of_text_ = 0;     // its place in the source
  std::size_t begin_ = 0, next_ = 0;  // of the token that is scanned, and how far that is, in text_
  std::shared_ptr<const std::string> memory_, memory_before_;  // of text_, and of the token before
  bool ended_ = false;                                         // there is nothing behind text_
  UsdToken token_;
};

}  // namespace drape
