#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "reports/page.hpp"

namespace drape {

/// Purpose of a diagram's files.
enum class FigureStyle {
  screen,     ///< with a title, in colours and sizes of the pages: SVG, PDF and PNG
  paper,      ///< for a column of an article, 3.3 in wide: SVG, PDF and pgfplots
  paper_wide  ///< for the whole width of a page of two columns, 7 in
};

/// Names of the styles on the command line, in the enumeration's order.
inline constexpr std::array figure_style_names{"screen", "paper", "paper-wide"};

constexpr const char* name_of(FigureStyle style) { return figure_style_names.at(static_cast<std::size_t>(style)); }

/// Returns the width of a figure for an article [in].
constexpr double paper_width(FigureStyle style) { return style == FigureStyle::paper_wide ? 7.0 : 3.3; }

}  // namespace drape

namespace drape::html {

/// A line of a legend.
struct LegendEntry {
  std::string style;  ///< class of the key
  Markup key;         ///< SVG around the origin, 24 wide and 14 high
  std::string label;
};

/// A drawing and its texts, which pages and files lay out differently.
struct Diagram {
  std::string title;    ///< description in a sentence, also for screen readers
  std::string y_title;  ///< title of the vertical axis, above it
  std::vector<LegendEntry> legend;
  double width = 0, height = 0;  ///< size of the drawing [CSS pixels]
  Markup drawing;                ///< SVG
};

/// Returns the drawing alone, inline in a page; it scales with the page.
/// @param more attributes of the svg element
Markup inline_svg(const Diagram& diagram, const Attributes& more = {});

/// Returns the legend for a page; empty without entries.
Markup legend(const std::vector<LegendEntry>& entries);

/// Returns a complete SVG document with title, legend, axes and style: light, on white, in the reader's sans-serif
/// font.
std::string svg_file(const Diagram& diagram);

/// Font size of a figure for an article: 8 pt [CSS pixels].
inline constexpr double paper_font = 8.0 * 96 / 72;

/// Returns an SVG document for an article: of this width, with the legend but no title, in a serif font of 8 pt.
std::string paper_file(const Diagram& diagram, double inches);

/// Returns a colour of the light theme, for example of "--s0": "#004f9e".
std::string light_color(const std::string& name);

/// Returns the number of letters in a UTF-8 text.
double letters(std::string_view text);

/// Formats a number for a drawing.
std::string coordinate(double value);
/// @param anchor "start", "middle" or "end"
Markup svg_text(double x, double y, const std::string& anchor, const std::string& text, const Attributes& more = {});
Markup svg_line(const std::string& style, double x1, double y1, double x2, double y2);

}  // namespace drape::html
