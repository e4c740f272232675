#pragma once

#include <string>
#include <vector>

#include "drape/core/rgb.hpp"
#include "drape/render/image.hpp"
#include "drape/render/overlay/fonts.hpp"

namespace drape {

/// A rectangle of a picture, from its top left [pixels].
struct PictureBox {
  int left = 0, top = 0, width = 0, height = 0;
  [[nodiscard]] int right() const { return left + width; }
  [[nodiscard]] int bottom() const { return top + height; }
};

/// Background of a text's letters.
enum class Backing {
  none,
  halo,  ///< a soft rim in the colour that contrasts with the letters
  panel  ///< a rectangle in that colour
};

/// Returns black or white: the one with the larger contrast ratio to a colour (WCAG 2.1).
Rgb contrasting(const Rgb& color);

/// Draws text, lines and rectangles into pictures. Partly covered pixels are mixed in linear light, as a camera would
/// see them; parts outside a picture are clipped. Use it from one thread at a time.
class Pen {
 public:
  /// @throws OutputError as Fonts
  Pen() = default;

  [[nodiscard]] Fonts& fonts() { return fonts_; }

  /// Returns the width of a line of text [pixels].
  int width(const std::string& line, int size);

  /// Returns the height of a line of text, with the gap to the next [pixels].
  static int line_height(int size) { return size + (size + 3) / 4; }

  /// Breaks a text into lines no wider than `width` [pixels]: at line feeds, at spaces, and otherwise between letters.
  std::vector<std::string> wrap(const std::string& text, int size, int width);

  /// Writes a line.
  /// @param left, base pen position of the first letter [pixels]
  /// @param size       font size [pixels]
  void write(Image& image, int left, int base, const std::string& line, int size, const Rgb& color,
             Backing backing = Backing::none);

  /// Draws a line with round ends.
  /// @param width width of the line [pixels]
  static void line(Image& image, double x0, double y0, double x1, double y1, double width, const Rgb& color);

  /// Fills a rectangle. @param part opacity, 0 to 1
  static void fill(Image& image, const PictureBox& box, const Rgb& color, double part = 1);

 private:
  /// Fraction of each pixel that letters cover.
  struct Mask {
    PictureBox box;
    std::vector<float> coverage;
  };
  Mask mask(const std::string& line, int size, int rim);
  static Mask widened(const Mask& letters, int radius);
  static void stamp(Image& image, const Mask& mask, int left, int base, const Rgb& color, float strength);

  Fonts fonts_;
};

}  // namespace drape
