#pragma once

#include <array>
#include <cstddef>

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
