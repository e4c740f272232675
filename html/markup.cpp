#include "html/markup.hpp"

#include <algorithm>
#include <array>

#include "core/text.hpp"

namespace drape::html {
namespace {

constexpr std::array<std::string_view, 6> void_elements{"br", "hr", "img", "input", "link", "meta"};

}  // namespace

std::string escape(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : printable(text)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

Markup::Markup(std::string_view text) : html_(escape(text)) {}

Markup Markup::trusted(std::string html) {
  Markup markup;
  markup.html_ = std::move(html);
  return markup;
}

Markup& Markup::operator+=(const Markup& other) {
  html_ += other.html_;
  return *this;
}

Markup element(std::string_view tag, const Attributes& attributes, const Markup& content) {
  std::string html("<");
  html += tag;
  for (const auto& [name, value] : attributes) {
    const bool optional = name.ends_with('?');
    if (optional && value.empty()) continue;
    html += ' ';
    html += optional ? name.substr(0, name.size() - 1) : name;
    if (optional) continue;
    html += "=\"";
    html += escape(value);
    html += '"';
  }
  html += '>';
  if (std::find(void_elements.begin(), void_elements.end(), tag) == void_elements.end()) {
    html += content.html();
    html += "</";
    html += tag;
    html += '>';
  }
  return Markup::trusted(std::move(html));
}

Markup join(const std::vector<Markup>& pieces) {
  Markup all;
  for (const Markup& piece : pieces) all += piece;
  return all;
}

std::string data_uri(std::string_view type, std::string_view bytes) {
  std::string uri("data:");
  uri += type;
  uri += ";base64,";
  uri += base64(bytes);
  return uri;
}

}  // namespace drape::html
