#include "scene/usd/lexer.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace drape {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Bytes from 0x80 on are letters of UTF-8 names.
bool starts_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || static_cast<unsigned char>(c) >= 0x80;
}

bool continues_word(char c) { return starts_word(c) || is_digit(c); }

std::string found(const UsdToken& token) {
  return token.kind == UsdToken::Kind::end ? "the end of the file" : in_quotes(token.text);
}

char closing(char opening) { return opening == '(' ? ')' : opening == '[' ? ']' : '}'; }

}  // namespace

UsdLexer::UsdLexer(const SourceText& source, std::size_t offset)
    : source_(&source), begin_of_text_(offset), ended_(!source.stays_in_file()) {
  std::string piece;
  const std::string_view text = source.piece(offset, piece);
  if (source.stays_in_file()) {
    memory_ = std::make_shared<const std::string>(std::move(piece));
    text_ = *memory_;
  } else {
    text_ = text;
  }
  token_ = scan();
}

/// Appends a piece to the text in memory and keeps the current token.
/// @returns false at the end of the text
bool UsdLexer::read_more() {
  if (ended_) return false;
  std::string kept(text_.substr(begin_)), piece;
  const std::size_t before = kept.size();
  // Double the text, so that the time for a token of any length is linear.
  do {
    ended_ = source_->piece(begin_of_text_ + begin_ + kept.size(), piece).empty();
    kept += piece;
  } while (!ended_ && kept.size() < 2 * before);
  if (kept.size() == before) return false;
  // The previous token lies in the memory in which this scan began.
  if (memory_before_ == nullptr) memory_before_ = memory_;
  memory_ = std::make_shared<const std::string>(std::move(kept));
  text_ = *memory_;
  begin_of_text_ += begin_;
  next_ -= begin_;
  begin_ = 0;
  return true;
}

/// Advances to the next occurrence of a mark, or to the end of the text.
/// @param keep true if the current token extends up to there
void UsdLexer::find(std::string_view mark, bool keep) {
  do {
    const std::size_t found = text_.find(mark, next_);
    if (found != std::string_view::npos) {
      next_ = found;
      return;
    }
    next_ = std::max(next_, text_.size() - std::min(text_.size(), mark.size() - 1));
    if (!keep) begin_ = next_;
  } while (read_more());
  next_ = text_.size();
}

void UsdLexer::skip_blanks_and_comments() {
  while (!at_end()) {
    begin_ = next_;  // drop everything before
    const char c = peek();
    if (c == '#' || (c == '/' && peek(1) == '/')) {
      find("\n", false);
    } else if (c == '/' && peek(1) == '*') {
      const std::size_t offset = here();
      next_ += 2;
      find("*/", false);
      if (at_end()) source_->fail(offset, "this comment is never closed");
      next_ += 2;
    } else if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
      ++next_;
    } else {
      return;
    }
  }
  begin_ = next_;
}

UsdToken UsdLexer::scan() {
  using Kind = UsdToken::Kind;
  memory_before_.reset();
  skip_blanks_and_comments();
  if (at_end()) return {Kind::end, here(), {}};
  const auto token = [&](Kind kind) {
    return UsdToken{kind, begin_of_text_ + begin_, text_.substr(begin_, next_ - begin_)};
  };

  const char c = peek();
  const std::size_t sign = c == '-' || c == '+' ? 1 : 0;
  if (is_digit(peek(sign)) || (peek(sign) == '.' && is_digit(peek(sign + 1)))) {
    next_ += sign;
    while (is_digit(peek()) || peek() == '.') ++next_;
    const std::size_t exponent_sign = peek(1) == '-' || peek(1) == '+' ? 1 : 0;
    if ((peek() == 'e' || peek() == 'E') && is_digit(peek(1 + exponent_sign))) {
      next_ += 1 + exponent_sign;
      while (is_digit(peek())) ++next_;
    }
    return token(Kind::number);
  }
  if (starts_word(peek(sign))) {  // with a sign: -inf
    next_ += sign;
    while (continues_word(peek()) || (peek() == ':' && (continues_word(peek(1)) || peek(1) == ':'))) ++next_;
    return token(Kind::word);
  }
  if (c == '"' || c == '\'') return scan_string(c);
  if (c == '@') return scan_asset();
  if (c == '<') {
    while (!at_end() && peek() != '>' && peek() != '\n') ++next_;
    if (peek() != '>') source_->fail(begin_of_text_ + begin_, "this path is never closed by '>'");
    ++next_;
    return token(Kind::path);
  }
  if (c == '\0' || std::string_view("()[]{}=,:;.&").find(c) == std::string_view::npos) {
    source_->fail(here(), "unexpected character " + in_quotes(text_.substr(begin_, 1)));
  }
  ++next_;
  return token(Kind::symbol);
}

UsdToken UsdLexer::scan_string(char quote) {
  const bool triple = peek(1) == quote && peek(2) == quote;
  const std::size_t width = triple ? 3 : 1;
  for (next_ += width; !at_end(); ++next_) {
    if (peek() == '\\') {
      if (peek(1) != '\0') ++next_;
    } else if (peek() == '\n' && !triple) {
      break;
    } else if (peek() == quote && (!triple || (peek(1) == quote && peek(2) == quote))) {
      const std::string_view inside = text_.substr(begin_ + width, next_ - begin_ - width);
      next_ += width;
      return {UsdToken::Kind::string, begin_of_text_ + begin_, inside};
    }
  }
  source_->fail(begin_of_text_ + begin_, fmt::format("this string is never closed by {}", std::string(width, quote)));
}

UsdToken UsdLexer::scan_asset() {
  const std::string_view mark = peek(1) == '@' && peek(2) == '@' ? "@@@" : "@";
  next_ += mark.size();
  find(mark, true);
  if (at_end()) {
    source_->fail(begin_of_text_ + begin_, fmt::format("this file name is never closed by {}", mark));
  }
  next_ += mark.size();
  return {UsdToken::Kind::asset, begin_of_text_ + begin_, text_.substr(begin_, next_ - begin_)};
}

UsdToken UsdLexer::take() {
  const UsdToken taken = token_;
  token_ = scan();
  return taken;
}

bool UsdLexer::accept(char symbol) {
  if (!at(symbol)) return false;
  take();
  return true;
}

UsdToken UsdLexer::expect(UsdToken::Kind kind, const std::string& what) {
  if (!at(kind)) fail_expected(what);
  return take();
}

void UsdLexer::expect(char symbol, const std::string& what) {
  if (!accept(symbol)) fail_expected(what);
}

void UsdLexer::fail_expected(const std::string& what) const {
  source_->fail(token_.offset, fmt::format("expected {}, found {}", what, found(token_)));
}

std::optional<double> UsdLexer::accept_number() {
  if (!at(UsdToken::Kind::number)) return std::nullopt;
  const std::string_view digits = token_.text.substr(token_.text[0] == '+' ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) return std::nullopt;
  take();
  return value;
}

void UsdLexer::skip_brackets() {
  struct Bracket {
    char sign;
    std::size_t offset;
  };
  std::vector<Bracket> open;
  do {
    if (at('(') || at('[') || at('{')) {
      open.push_back({token_.text[0], token_.offset});
    } else if (at(')') || at(']') || at('}') || at(UsdToken::Kind::end)) {
      const char expected = closing(open.back().sign);
      if (!at(expected)) {
        fail_expected(
            fmt::format("'{}' for the '{}' of line {}", expected, open.back().sign, source_->line(open.back().offset)));
      }
      open.pop_back();
    }
    take();
  } while (!open.empty());
}

void UsdLexer::skip_value() {
  if (at('(') || at('[') || at('{')) return skip_brackets();
  if (at(UsdToken::Kind::end) || at(UsdToken::Kind::symbol)) fail_expected("a value");
  // A reference to a prim of another file is two tokens, @file@</Prim>.
  if (take().kind == UsdToken::Kind::asset && at(UsdToken::Kind::path)) take();
}

}  // namespace drape
