#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// HTML composed from pieces that are well-formed by construction: text and attributes are escaped where they enter,
/// and nowhere else.
namespace drape::html {

/// A piece of HTML: text, elements, or a sequence of them.
class Markup {
 public:
  Markup() = default;
  /// Makes a piece from text, escaped.
  Markup(std::string_view text);
  Markup(const std::string& text) : Markup(std::string_view(text)) {}
  Markup(const char* text) : Markup(std::string_view(text)) {}

  /// Makes a piece from HTML: only for output of this library.
  static Markup trusted(std::string html);

  Markup& operator+=(const Markup& other);
  friend Markup operator+(Markup left, const Markup& right) { return left += right; }

  [[nodiscard]] const std::string& html() const { return html_; }
  [[nodiscard]] bool empty() const { return html_.empty(); }

 private:
  std::string html_;
};

/// An attribute of an element. A name that ends in '?' is boolean: it has no value, and is omitted if `value` is empty.
struct Attribute {
  std::string_view name;
  std::string value;
};
using Attributes = std::vector<Attribute>;

/// Returns <tag name="value" …>content</tag>; void elements such as img get no end tag.
Markup element(std::string_view tag, const Attributes& attributes, const Markup& content = {});
/// Makes an element without attributes. A template, because attributes in braces could be read as text as well.
template <class Content>
requires std::convertible_to<Content, Markup> Markup element(std::string_view tag, const Content& content) {
  return element(tag, {}, content);
}

/// Joins pieces in sequence.
Markup join(const std::vector<Markup>& pieces);

/// Writes & < > " ' as entities and replaces characters that HTML does not allow, see printable().
std::string escape(std::string_view text);

/// Returns the text of a piece, without its tags.
std::string plain_text(const Markup& markup);

/// Returns "data:TYPE;base64,…".
std::string data_uri(std::string_view type, std::string_view bytes);

/// A self-contained page: no network, no other file.
struct Page {
  std::string title;                                 ///< title of the window
  std::string kind;                                  ///< a small line above the heading: "drape check"
  Markup heading;                                    ///< result in one sentence
  Markup introduction;                               ///< text under the heading
  Markup content;                                    ///< sections
  std::vector<std::pair<std::string, Markup>> foot;  ///< machine, versions, revision: names and values
};

/// Returns the complete file.
std::string render(const Page& page);

/// Returns lines about this build and this machine for the foot of the page.
std::vector<std::pair<std::string, std::string>> provenance();

}  // namespace drape::html
