#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "html/markup.hpp"

namespace drape::html {

/// A line of a legend.
struct LegendEntry {
  std::string style;  ///< class of the key
  Markup key;         ///< SVG around the origin, 24 wide and 14 high
  std::string label;
};

/// A drawing and the words around it, which a page and a file set each in its own way.
struct Diagram {
  std::string title;    ///< what it shows, in a sentence: also for who cannot see it
  std::string y_title;  ///< of the vertical axis; stands above it
  std::vector<LegendEntry> legend;
  double width = 0, height = 0;  ///< of the drawing [CSS pixels]
  Markup drawing;                ///< SVG
};

/// The drawing alone, inline in a page; it grows and shrinks with it.
/// @param more attributes of the svg element
Markup inline_svg(const Diagram& diagram, const Attributes& more = {});

/// A legend of a page; empty if it has no entries.
Markup legend(const std::vector<LegendEntry>& entries);

/// A file of its own: an SVG document with title, legend, axes and style, light, on white, in the reader's font without
/// serifs.
std::string svg_file(const Diagram& diagram);

/// The letters of a text in UTF-8.
double letters(std::string_view text);

/// A number of a drawing.
std::string coordinate(double value);
/// @param anchor "start", "middle" or "end"
Markup svg_text(double x, double y, const std::string& anchor, const std::string& text, const Attributes& more = {});
Markup svg_line(const std::string& style, double x1, double y1, double x2, double y2);

}  // namespace drape::html
