#pragma once

namespace drape {

/// Purpose of a diagram's files.
enum class FigureStyle {
  screen,     ///< with a title, in colours and sizes of the pages: SVG, PDF and PNG
  paper,      ///< for a column of an article, 3.3 in wide: SVG, PDF and pgfplots
  paper_wide  ///< for the whole width of a page of two columns, 7 in
};

/// Returns the width of a figure for an article [in].
constexpr double paper_width(FigureStyle style) { return style == FigureStyle::paper_wide ? 7.0 : 3.3; }

}  // namespace drape
