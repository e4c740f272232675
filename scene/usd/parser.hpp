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
    end,     ///< end of the file
    number,  ///< 12, -0.5, 1e-7; inf and nan are words
    word,    ///< a name or keyword, with its namespaces: primvars:st
    string,  ///< "…", '…', """…""" or '''…'''
    asset,   ///< @…@ or @@@…@@@
    path,    ///< <…>
    symbol   ///< one of ( ) [ ] { } = , : ; . &
  };
  Kind kind = Kind::end;
  std::size_t offset = 0;  ///< offset of its first character
  /// The whole token; for strings the text between the quotes, with escapes. Valid until the lexer has moved on by two
  /// tokens.
  std::string_view text;
};

/// Tokenizer of a usda file; holds the current token. If the source stays in its file, memory holds the last two
/// tokens and one piece.
class UsdLexer {
 public:
  /// Starts at an offset between tokens.
  UsdLexer(const SourceText& source, std::size_t offset);

  [[nodiscard]] const UsdToken& token() const { return token_; }
  [[nodiscard]] bool at(UsdToken::Kind kind) const { return token_.kind == kind; }
  [[nodiscard]] bool at(char symbol) const { return at(UsdToken::Kind::symbol) && token_.text[0] == symbol; }
  [[nodiscard]] bool at_word(std::string_view word) const { return at(UsdToken::Kind::word) && token_.text == word; }

  /// Returns the token and advances to the next.
  UsdToken take();

  /// Advances to the next token if the current one is this symbol.
  bool accept(char symbol);

  /// Takes a token of the given kind. @throws UsageError "expected 'what', found …"
  UsdToken expect(UsdToken::Kind kind, const std::string& what);
  void expect(char symbol, const std::string& what);

  /// Skips a value of any kind without interpreting it; brackets must match.
  void skip_value();

  /// Takes a finite number and returns it; at any other token it returns nothing and stays.
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
  std::string_view text_;                                      // part of the source in memory
  std::size_t begin_of_text_ = 0;                              // offset of text_ in the source
  std::size_t begin_ = 0, next_ = 0;                           // start and scanned end of the current token in text_
  std::shared_ptr<const std::string> memory_, memory_before_;  // storage of text_ and of the previous token
  bool ended_ = false;                                         // text_ reaches the end of the source
  UsdToken token_;
};

}  // namespace drape
