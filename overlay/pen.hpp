#pragma once

#include <string>
#include <vector>

#include "core/rgb.hpp"
#include "overlay/fonts.hpp"
#include "render/image.hpp"

namespace drape {

/// A rectangle of a picture, from its top left [pixels].
struct PictureBox {
  int left = 0, top = 0, width = 0, height = 0;
  [[nodiscard]] int right() const { return left + width; }
  [[nodiscard]] int bottom() const { return top + height; }
};

/// What is behind the letters of a text.
enum class Backing {
  none,
  halo,  ///< a soft rim of the colour that contrasts with theirs
  panel  ///< a rectangle of it
};

/// Black or white, whichever a colour is read on better: that of the larger contrast ratio (WCAG 2.1).
Rgb contrasting(const Rgb& color);

/// Draws text, lines and rectangles into pictures. What covers part of a pixel is mixed with what is there in linear
/// light, as a camera would see it; what lies outside a picture is left out. Use it from one thread at a time.
class Pen {
 public:
  /// @throws OutputError as Fonts
  Pen() = default;

  [[nodiscard]] Fonts& fonts() { return fonts_; }

  /// How wide a line of text is [pixels].
  int width(const std::string& line, int size);

  /// Of a line of text, with what separates it from the next [pixels].
  static int line_height(int size) { return size + (size + 3) / 4; }

  /// Breaks a text into lines no wider than `width`, at spaces where there are any and else between letters, and where
  /// it has line feeds.
  std::vector<std::string> wrap(const std::string& text, int size, int width);

  /// Writes a line.
  /// @param left, base where the first letter stands [pixels]
  /// @param size       of the font [pixels]
  void write(Image& image, int left, int base, const std::string& line, int size, const Rgb& color,
             Backing backing = Backing::none);

  /// A line of round ends.
  /// @param width of the line [pixels]
  static void line(Image& image, double x0, double y0, double x1, double y1, double width, const Rgb& color);

  /// @param part of the colour that covers what is there, 0 to 1
  static void fill(Image& image, const PictureBox& box, const Rgb& color, double part = 1);

 private:
  /// How much of each pixel letters cover.
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
