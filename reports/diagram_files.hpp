#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "reports/chart.hpp"
#include "reports/result_table.hpp"

namespace drape {

/// Converter of SVG to PDF and PNG with librsvg and cairo, which the constructor loads.
class SvgPrinter {
 public:
  /// Returns the names of librsvg, cairo and GObject, in this order.
  static std::vector<std::string> library_names();
  /// Returns the Debian packages of the libraries.
  static const char* packages();

  /// @throws OutputError if a library is missing, with the packages to install
  explicit SvgPrinter(const std::vector<std::string>& names = library_names());
  ~SvgPrinter();
  SvgPrinter(const SvgPrinter&) = delete;
  SvgPrinter& operator=(const SvgPrinter&) = delete;

  /// Returns a PDF file of one page with embedded fonts; a pixel of the SVG is 0.75 points.
  /// @throws OutputError if the text is not SVG, or drawing fails
  [[nodiscard]] std::string pdf(const std::string& svg) const;

  /// Returns a PNG file with `scale` pixels per pixel of the SVG.
  /// @throws OutputError likewise
  [[nodiscard]] std::string png(const std::string& svg, double scale) const;

 private:
  struct Functions;
  std::unique_ptr<const Functions> call_;
};

struct NamedChart {
  std::string name;  ///< name of its files, without ending
  html::Chart chart;
};

/// Returns the points of a chart as a table, with their spread if given.
/// @param every stride of the points in each series; the last is always included
ResultTable points_table(const NamedChart& chart, std::size_t every = 1);

/// Writes NAME.svg into the folder, and from it NAME.pdf for LaTeX. In the style of the screen also NAME.png, of twice
/// the size, for word processors.
/// @returns a sentence about missing software if the PDF and PNG cannot be made; otherwise empty
/// @throws OutputError if a file cannot be written
std::string write_diagram(const html::Diagram& diagram, const std::filesystem::path& folder, const std::string& name,
                          FigureStyle style = FigureStyle::screen);

/// Returns the points of a chart as a table of numbers for pgfplots: columns x0 and y0 for the first series, x1 and y1
/// for the second, and so on. "nan" fills short columns and marks gaps.
std::string pgfplots_data(const html::Chart& chart);

/// Returns the chart as a tikzpicture for \input, which reads NAME.dat.
/// @param inches width
std::string pgfplots_picture(const NamedChart& chart, double inches);

/// Writes the diagram of a chart, and its points as CSV, Markdown and LaTeX; the latter two thin out long tables. For
/// an article also writes NAME.dat and NAME.tikz.tex for pgfplots.
std::string write_chart(const NamedChart& chart, const std::filesystem::path& folder,
                        FigureStyle style = FigureStyle::screen);

}  // namespace drape
