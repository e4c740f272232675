#pragma once

#include <memory>
#include <string>
#include <vector>

namespace drape {

/// Turns SVG into what LaTeX and word processors take, with librsvg and cairo, which are loaded when one is made.
class SvgPrinter {
 public:
  /// The libraries in the order of librsvg, cairo and GObject.
  static std::vector<std::string> library_names();
  /// The Debian packages that bring them.
  static const char* packages();

  /// @throws OutputError if a library is not there, with what to install
  explicit SvgPrinter(const std::vector<std::string>& names = library_names());
  ~SvgPrinter();
  SvgPrinter(const SvgPrinter&) = delete;
  SvgPrinter& operator=(const SvgPrinter&) = delete;

  /// A PDF file of one page, with the fonts that it uses; a pixel of the SVG is 0.75 points.
  /// @throws OutputError if it is no SVG, or nothing can be drawn
  [[nodiscard]] std::string pdf(const std::string& svg) const;

  /// A PNG file with so many pixels for one of the SVG.
  /// @throws OutputError likewise
  [[nodiscard]] std::string png(const std::string& svg, double scale) const;

 private:
  struct Functions;
  std::unique_ptr<const Functions> call_;
};

}  // namespace drape
