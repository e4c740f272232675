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
    : source_(&source), text_(source.text()), next_(offset) {
  token_ = scan();
}

char UsdLexer::peek(std::size_t ahead) const { return next_ + ahead < text_.size() ? text_[next_ + ahead] : '\0'; }

void UsdLexer::skip_blanks_and_comments() {
  while (next_ < text_.size()) {
    const char c = peek();
    if (c == '#' || (c == '/' && peek(1) == '/')) {
      next_ = std::min(text_.find('\n', next_), text_.size());
    } else if (c == '/' && peek(1) == '*') {
      const std::size_t end = text_.find("*/", next_ + 2);
      if (end == std::string_view::npos) source_->fail(next_, "this comment is never closed");
      next_ = end + 2;
    } else if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
      ++next_;
    } else {
      return;
    }
  }
}

UsdToken UsdLexer::scan() {
  using Kind = UsdToken::Kind;
  skip_blanks_and_comments();
  const std::size_t begin = next_;
  if (begin == text_.size()) return {Kind::end, begin, {}};
  const auto token = [&](Kind kind) { return UsdToken{kind, begin, text_.substr(begin, next_ - begin)}; };

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
    next_ = text_.find_first_of(">\n", begin);
    if (next_ == std::string_view::npos || text_[next_] == '\n')
      source_->fail(begin, "this path is never closed by '>'");
    ++next_;
    return token(Kind::path);
  }
  if (c == '\0' || std::string_view("()[]{}=,:;.&").find(c) == std::string_view::npos) {
    source_->fail(begin, "unexpected character " + in_quotes(text_.substr(begin, 1)));
  }
  ++next_;
  return token(Kind::symbol);
}

UsdToken UsdLexer::scan_string(char quote) {
  const std::size_t begin = next_;
  const bool triple = peek(1) == quote && peek(2) == quote;
  const std::size_t width = triple ? 3 : 1;
  for (next_ += width; next_ < text_.size(); ++next_) {
    if (peek() == '\\') {
      ++next_;
    } else if (peek() == '\n' && !triple) {
      break;
    } else if (peek() == quote && (!triple || (peek(1) == quote && peek(2) == quote))) {
      const std::string_view inside = text_.substr(begin + width, next_ - begin - width);
      next_ += width;
      return {UsdToken::Kind::string, begin, inside};
    }
  }
  source_->fail(begin, fmt::format("this string is never closed by {}", std::string(width, quote)));
}

UsdToken UsdLexer::scan_asset() {
  const std::size_t begin = next_;
  const std::string_view mark = peek(1) == '@' && peek(2) == '@' ? "@@@" : "@";
  const std::size_t end = text_.find(mark, begin + mark.size());
  if (end == std::string_view::npos) source_->fail(begin, fmt::format("this file name is never closed by {}", mark));
  next_ = end + mark.size();
  return {UsdToken::Kind::asset, begin, text_.substr(begin, next_ - begin)};
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
  std::vector<UsdToken> open;
  do {
    if (at('(') || at('[') || at('{')) {
      open.push_back(token_);
    } else if (at(')') || at(']') || at('}') || at(UsdToken::Kind::end)) {
      const char expected = closing(open.back().text[0]);
      if (!at(expected)) {
        fail_expected(
            fmt::format("'{}' for the '{}' of line {}", expected, open.back().text, source_->line(open.back().offset)));
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
