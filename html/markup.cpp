#include "html/markup.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace drape::html {
namespace {

constexpr std::array<std::string_view, 6> void_elements{"br", "hr", "img", "input", "link", "meta"};
constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

/// How many bytes the character takes that the text begins with; 0 if it is none in UTF-8 (RFC 3629), or none that HTML
/// and XML allow.
std::size_t character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return (lead < 0x20 && lead != '\n' && lead != '\t') || lead == 0x7f ? 0 : 1;
  const std::size_t size = lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : lead < 0xf5 ? 4 : 0;
  if (size > text.size()) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  if (size < 3) return size;
  const bool overlong = (lead == 0xe0 && byte(1) < 0xa0) || (lead == 0xf0 && byte(1) < 0x90);
  const bool surrogate = lead == 0xed && byte(1) > 0x9f, beyond = lead == 0xf4 && byte(1) > 0x8f;
  const bool none = text.starts_with("\xEF\xBF\xBE") || text.starts_with("\xEF\xBF\xBF");
  return overlong || surrogate || beyond || none ? 0 : size;
}

/// RFC 4648, section 4.
std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace

std::string escape(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    const std::string_view character = text.substr(0, size);
    text.remove_prefix(std::max<std::size_t>(1, size));
    switch (size == 1 ? character[0] : '\0') {
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
        escaped += size == 0 ? replacement : character;
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
