#pragma once

#include <memory>
#include <string>
#include <vector>

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

}  // namespace drape
