#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <vector>

/// HTML in pieces that fit together. A piece is well-formed by construction: text and attributes are escaped where they
/// enter, and nowhere else.
namespace drape::html {

/// A piece of HTML: text, elements, or several of them in a row.
class Markup {
 public:
  Markup() = default;
  /// Text, escaped.
  Markup(std::string_view text);
  Markup(const std::string& text) : Markup(std::string_view(text)) {}
  Markup(const char* text) : Markup(std::string_view(text)) {}

  /// A piece that is HTML already: only for what this library makes itself.
  static Markup trusted(std::string html);

  Markup& operator+=(const Markup& other);
  friend Markup operator+(Markup left, const Markup& right) { return left += right; }

  [[nodiscard]] const std::string& html() const { return html_; }
  [[nodiscard]] bool empty() const { return html_.empty(); }

 private:
  std::string html_;
};

/// One attribute of an element. A name that ends in '?' stands without a value if `value` is not empty, and is left out
/// if it is.
struct Attribute {
  std::string_view name;
  std::string value;
};
using Attributes = std::vector<Attribute>;

/// <tag name="value" …>content</tag>, without an end tag for elements that have no content, such as img.
Markup element(std::string_view tag, const Attributes& attributes, const Markup& content = {});
/// A template, since attributes in braces could be read as text as well.
template <class Content>
requires std::convertible_to<Content, Markup> Markup element(std::string_view tag, const Content& content) {
  return element(tag, {}, content);
}

/// The pieces one after another.
Markup join(const std::vector<Markup>& pieces);

/// The text with & < > " ' written as entities, and what HTML does not allow replaced, see printable().
std::string escape(std::string_view text);

/// "data:TYPE;base64,…"
std::string data_uri(std::string_view type, std::string_view bytes);

}  // namespace drape::html
