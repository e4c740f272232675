#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// The picture of a letter.
struct Glyph {
  int left = 0, top = 0;               ///< from the pen to the left column, and from the base line up to the top row
  int width = 0, height = 0;           ///< [pixels]
  double advance = 0;                  ///< to the next letter [pixels]
  std::vector<std::uint8_t> coverage;  ///< width·height, rows from top to bottom, 255 is all of a pixel
};

/// The Unicode characters of a text in UTF-8; U+FFFD stands for each byte that is none.
std::u32string characters(std::string_view utf8);

/// The fonts of this machine, in the order in which fontconfig prefers them for text without serifs: each character
/// comes from the first that has it. FreeType and fontconfig are loaded when the first one is made. Use it from one
/// thread at a time.
class Fonts {
 public:
  /// The Debian packages that bring both libraries, and letters for every language.
  static const char* packages();

  /// @throws OutputError if a library is not there, or no font is, with what to install
  Fonts();
  ~Fonts();
  Fonts(const Fonts&) = delete;
  Fonts& operator=(const Fonts&) = delete;

  /// Of a character in the first font that has it, or else the box that stands for what is missing.
  /// @param size of the font [pixels]
  const Glyph& glyph(char32_t character, int size);

  /// @throws OutputError naming the characters of the text that no font has, with what to install
  void require(std::string_view utf8);

  /// The name and the file of the font that a character comes from: "DejaVu Sans (/usr/…/DejaVuSans.ttf)"; empty: none.
  std::string source(char32_t character);

 private:
  struct Functions;
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace drape
