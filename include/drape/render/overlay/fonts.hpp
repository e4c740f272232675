#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

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

  /// Requires a font for each character. @throws OutputError with the missing characters and the packages to install
  void require(std::string_view utf8);

  /// Returns name and file of a character's font: "DejaVu Sans (/usr/…/DejaVuSans.ttf)"; empty: none.
  std::string source(char32_t character);

 private:
  struct Functions;
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace drape
