#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "drape/core/rgb.hpp"
#include "drape/render/image.hpp"

namespace drape {

/// The picture of a character.
struct Glyph {
  int left = 0, top = 0;               ///< from the pen to the left column, and from the base line up to the top row
  int width = 0, height = 0;           ///< [pixels]
  double advance = 0;                  ///< to the next character [pixels]
  std::vector<std::uint8_t> coverage;  ///< width·height, rows from top to bottom, 255: fully covered
};

/// Decodes a text in UTF-8 to Unicode characters; U+FFFD replaces each invalid byte.
std::u32string characters(std::string_view utf8);

/// The fonts of this machine, in fontconfig's order for sans-serif text; each character comes from the first font that
/// has it. FreeType and fontconfig are loaded when the first object is made. Use it from one thread at a time.
class Fonts {
 public:
  /// Returns the Debian packages of both libraries, and of fonts for every language.
  static const char* packages();

  /// @throws OutputError with the packages to install, if a library or all fonts are missing
  Fonts();
  ~Fonts();
  Fonts(const Fonts&) = delete;
  Fonts& operator=(const Fonts&) = delete;

  /// Returns a character's picture in the first font that has it, or the font's box for missing characters.
  /// @param size font size [pixels]
  const Glyph& glyph(char32_t character, int size);

  /// Requires a font for each character.
  /// @throws OutputError with the missing characters and the packages to install
  void require(std::string_view utf8);

  /// Returns name and file of a character's font: "DejaVu Sans (/usr/…/DejaVuSans.ttf)"; empty: none.
  std::string source(char32_t character);

 private:
  struct Functions;
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

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

  /// Fills a rectangle.
  /// @param part opacity, 0 to 1
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
