#pragma once

#include <cstddef>
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
  std::string_view text;   ///< all of it; of strings, what is between the quotes, escapes left as they are
};

/// Splits a usda file into tokens and keeps the one to look at next.
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
  void skip_blanks_and_comments();
  UsdToken scan();
  UsdToken scan_string(char quote);
  UsdToken scan_asset();
  void skip_brackets();
  [[nodiscard]] char peek(std::size_t ahead = 0) const;

  const SourceText* source_;
  std::string_view text_;
  std::size_t next_;  // just behind token_
  UsdToken token_;
};

}  // namespace drape
