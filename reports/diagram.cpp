#include "reports/diagram.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "html_assets.hpp"

namespace drape::html {
namespace {

// Layout of a file [CSS pixels].
constexpr double margin = 20, least_width = 400, line_height = 20;
constexpr double title_size = 15, label_size = 13;
constexpr double letter = 0.56;  // letter width relative to the font size, for a wide font: the reader's is unknown
constexpr double key_width = 24, key_gap = 8, entry_gap = 20;

/// Wraps text to lines of at most `widest` letters; longer words stay whole.
std::vector<std::string> wrapped(std::string_view text, double widest) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (lines.empty() || letters(lines.back()) + 1 + letters(word) > widest) {
      lines.emplace_back(word);
    } else {
      lines.back().append(" ").append(word);
    }
  }
  return lines;
}

/// Returns the style sheet with the light theme's colours in place of variables, which some SVG readers do not support.
std::string plain_style() {
  std::string css(diagram_css);
  for (std::size_t at = 0; (at = css.find("var(", at)) != std::string::npos;) {
    const std::size_t end = css.find(')', at);
    const std::string name = css.substr(at + 4, end - at - 4) + ": ";
    const std::size_t value = theme_css.find(name) + name.size();  // the light theme comes first
    css.replace(at, end + 1 - at, theme_css.substr(value, theme_css.find(';', value) - value));
  }
  return css;
}

/// Vertical layout of the parts of a file.
class FileLayout {
 public:
  explicit FileLayout(double width) : width_(width) {}

  void add_title(const std::string& title) {
    for (const std::string& line : wrapped(title, width_ / (letter * title_size))) {
      parts_ += svg_text(margin, below_ + title_size, "start", line, {{"class", "heading"}});
      below_ += line_height;
    }
  }

  void add_legend(const std::vector<LegendEntry>& entries) {
    if (entries.empty()) return;
    double x = 0, y = below_ + line_height;
    for (const LegendEntry& entry : entries) {
      const double width = key_width + key_gap + letter * label_size * letters(entry.label);
      if (x > 0 && x + width > width_) x = 0, y += line_height;
      const std::string place = fmt::format("translate({:.1f} {:.1f})", margin + x + key_width / 2, y - 4.5);
      parts_ += element("g", {{"class", entry.style}, {"transform", place}}, entry.key) +
                svg_text(margin + x + key_width + key_gap, y, "start", entry.label, {{"class", "label"}});
      x += width + entry_gap;
    }
    below_ = y;
  }

  void add_drawing(const Diagram& diagram) {
    below_ += line_height + 4;
    parts_ += svg_text(margin, below_, "start", diagram.y_title);
    below_ += 6;
    parts_ += element("g", {{"transform", fmt::format("translate({:.1f} {:.1f})", margin, below_)}}, diagram.drawing);
    below_ += diagram.height;
  }

  [[nodiscard]] const Markup& parts() const { return parts_; }
  [[nodiscard]] double height() const { return below_ + margin; }

 private:
  double width_, below_ = margin - 4;
  Markup parts_;
};

}  // namespace

double letters(std::string_view text) {
  return static_cast<double>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string coordinate(double value) { return fmt::format("{:.1f}", value); }

Markup svg_text(double x, double y, const std::string& anchor, const std::string& text, const Attributes& more) {
  Attributes attributes{{"x", coordinate(x)}, {"y", coordinate(y)}, {"text-anchor", anchor}};
  attributes.insert(attributes.end(), more.begin(), more.end());
  return element("text", attributes, text);
}

Markup svg_line(const std::string& style, double x1, double y1, double x2, double y2) {
  return element("line", {{"class", style},
                          {"x1", coordinate(x1)},
                          {"y1", coordinate(y1)},
                          {"x2", coordinate(x2)},
                          {"y2", coordinate(y2)}});
}

Markup inline_svg(const Diagram& diagram, const Attributes& more) {
  Attributes attributes{{"viewBox", fmt::format("0 0 {} {}", diagram.width, diagram.height)}, {"role", "img"}};
  attributes.insert(attributes.end(), more.begin(), more.end());
  return element("svg", attributes, diagram.drawing);
}

Markup legend(const std::vector<LegendEntry>& entries) {
  Markup items;
  for (const LegendEntry& entry : entries) {
    const Markup key = element(
        "svg", {{"class", "key " + entry.style}, {"viewBox", "-12 -7 24 14"}, {"aria-hidden", "true"}}, entry.key);
    items += element("li", key + entry.label);
  }
  return entries.empty() ? items : element("ul", {{"class", "legend"}}, items);
}

std::string svg_file(const Diagram& diagram) {
  const double inside = std::max(diagram.width, least_width);
  FileLayout layout(inside);
  layout.add_title(diagram.title);
  layout.add_legend(diagram.legend);
  layout.add_drawing(diagram);
  const std::string width = fmt::format("{:.0f}", inside + 2 * margin), height = fmt::format("{:.0f}", layout.height());
  const Attributes attributes{{"xmlns", "http://www.w3.org/2000/svg"},
                              {"class", "chart file"},
                              {"role", "img"},
                              {"width", width},
                              {"height", height},
                              {"viewBox", "0 0 " + width + " " + height}};
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
         element("svg", attributes,
                 element("title", diagram.title) + element("style", plain_style()) +
                     element("rect", {{"width", width}, {"height", height}, {"fill", "#fff"}}) + layout.parts())
             .html() +
         "\n";
}

}  // namespace drape::html
