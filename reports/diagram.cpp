#include "reports/diagram.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "html_assets.hpp"

namespace drape::html {
namespace {

/// Layout of a file [CSS pixels].
struct FileForm {
  double margin = 20, line_height = 20;
  double title_size = 15, label_size = 13;
  double letter = 0.56;  // letter width relative to the font size, for a wide font: the reader's is unknown
  double key_scale = 1, key_gap = 8, entry_gap = 20, key_rise = 4.5;
  double before_drawing = 4, after_title = 6;
};
constexpr FileForm paper_form{.margin = 1,
                              .line_height = 13,
                              .label_size = paper_font,
                              .letter = 0.58,  // of DejaVu Serif, wider than Times, for which it may stand in
                              .key_scale = 0.75,
                              .key_gap = 4,
                              .entry_gap = 10,
                              .key_rise = 3.5,
                              .before_drawing = -7,
                              .after_title = 3};
constexpr double least_width = 400, key_width = 24;

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
    css.replace(at, end + 1 - at, light_color(css.substr(at + 4, end - at - 4)));
  }
  return css;
}

/// Vertical layout of the parts of a file.
class FileLayout {
 public:
  FileLayout(double width, const FileForm& form) : form_(form), width_(width), below_(std::max(0.0, form.margin - 4)) {}

  void add_title(const std::string& title) {
    for (const std::string& line : wrapped(title, width_ / (form_.letter * form_.title_size))) {
      parts_ += svg_text(form_.margin, below_ + form_.title_size, "start", line, {{"class", "heading"}});
      below_ += form_.line_height;
    }
  }

  void add_legend(const std::vector<LegendEntry>& entries) {
    if (entries.empty()) return;
    const double key = form_.key_scale * key_width;
    double x = 0, y = below_ + form_.line_height;
    for (const LegendEntry& entry : entries) {
      const double width = key + form_.key_gap + form_.letter * form_.label_size * letters(entry.label);
      if (x > 0 && x + width > width_) x = 0, y += form_.line_height;
      std::string place = fmt::format("translate({:.1f} {:.1f})", form_.margin + x + key / 2, y - form_.key_rise);
      if (form_.key_scale != 1) place += fmt::format(" scale({:g})", form_.key_scale);
      parts_ += element("g", {{"class", entry.style}, {"transform", place}}, entry.key) +
                svg_text(form_.margin + x + key + form_.key_gap, y, "start", entry.label, {{"class", "label"}});
      x += width + form_.entry_gap;
    }
    below_ = y;
  }

  /// @param scale scale of the drawing
  void add_drawing(const Diagram& diagram, double scale = 1) {
    if (!diagram.y_title.empty()) {
      below_ += form_.line_height + std::max(0.0, form_.before_drawing);
      parts_ += svg_text(form_.margin, below_, "start", diagram.y_title);
      below_ += form_.after_title;
    } else {
      below_ += form_.line_height + form_.before_drawing;
    }
    std::string place = fmt::format("translate({:.1f} {:.1f})", form_.margin, below_);
    if (scale != 1) place += fmt::format(" scale({:.4f})", scale);
    Attributes attributes{{"transform", place}};
    if (scale != 1) attributes.push_back({"class", "scaled"});
    parts_ += element("g", attributes, diagram.drawing);
    below_ += scale * diagram.height;
  }

  [[nodiscard]] const Markup& parts() const { return parts_; }
  [[nodiscard]] double height() const { return below_ + form_.margin; }

 private:
  FileForm form_;
  double width_, below_;
  Markup parts_;
};

/// Returns a document with a white background.
std::string svg_document(const std::string& style_class, const std::string& width, const std::string& height,
                         std::array<std::string, 2> size, const std::string& title, const std::string& style,
                         const Markup& parts) {
  const Attributes attributes{{"xmlns", "http://www.w3.org/2000/svg"},
                              {"class", style_class},
                              {"role", "img"},
                              {"width", width},
                              {"height", height},
                              {"viewBox", "0 0 " + size[0] + " " + size[1]}};
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
         element("svg", attributes,
                 element("title", title) + element("style", style) +
                     element("rect", {{"width", size[0]}, {"height", size[1]}, {"fill", "#fff"}}) + parts)
             .html() +
         "\n";
}

}  // namespace

std::string light_color(const std::string& name) {
  const std::size_t value = theme_css.find(name + ": ") + name.size() + 2;  // the light theme comes first
  return std::string(theme_css.substr(value, theme_css.find(';', value) - value));
}

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
  const FileForm form;
  const double inside = std::max(diagram.width, least_width);
  FileLayout layout(inside, form);
  layout.add_title(diagram.title);
  layout.add_legend(diagram.legend);
  layout.add_drawing(diagram);
  const std::string width = fmt::format("{:.0f}", inside + 2 * form.margin),
                    height = fmt::format("{:.0f}", layout.height());
  return svg_document("chart file", width, height, {width, height}, diagram.title, plain_style(), layout.parts());
}

std::string paper_file(const Diagram& diagram, double inches) {
  constexpr double inch = 96;
  const double width = inch * inches, inside = width - 2 * paper_form.margin, scale = inside / diagram.width;
  // A drawing made for this width keeps its scale; any other keeps its font size.
  const bool fits = std::abs(diagram.width - width) < 1;
  FileLayout layout(inside, paper_form);
  layout.add_legend(diagram.legend);
  layout.add_drawing(diagram, fits ? 1 : scale);
  const std::string style =
      fits ? "" : fmt::format(".paper .scaled text {{ font-size: {:.3f}px; }}\n", paper_font / scale);
  return svg_document("chart file paper", fmt::format("{:g}in", inches),
                      fmt::format("{:.4f}in", layout.height() / inch),
                      {fmt::format("{:.1f}", width), fmt::format("{:.1f}", layout.height())}, diagram.title,
                      plain_style() + std::string(paper_css) + style, layout.parts());
}

}  // namespace drape::html
