#include "drape/render/overlay/fonts.hpp"

#include <fmt/format.h>
#include <fontconfig/fontconfig.h>
#include <ft2build.h>

#include FT_FREETYPE_H

#include <algorithm>
#include <map>
#include <utility>

#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"

namespace drape {
namespace {

std::string utf8(char32_t character) {
  const auto code = static_cast<std::uint32_t>(character);
  const auto byte = [&](std::uint32_t mark, unsigned shift, std::uint32_t mask) {
    return static_cast<char>(mark | ((code >> shift) & mask));
  };
  if (code < 0x80) return {byte(0, 0, 0x7F)};
  if (code < 0x800) return {byte(0xC0, 6, 0x1F), byte(0x80, 0, 0x3F)};
  if (code < 0x10000) return {byte(0xE0, 12, 0x0F), byte(0x80, 6, 0x3F), byte(0x80, 0, 0x3F)};
  return {byte(0xF0, 18, 0x07), byte(0x80, 12, 0x3F), byte(0x80, 6, 0x3F), byte(0x80, 0, 0x3F)};
}

}  // namespace

std::u32string characters(std::string_view utf8) {
  const std::string text = printable(utf8);
  std::u32string result;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 1;
    std::uint32_t code = length == 1 ? first : first & (0x7FU >> length);
    for (std::size_t k = 1; k < length; ++k) code = code << 6U | (static_cast<unsigned char>(text[i + k]) & 0x3FU);
    result += static_cast<char32_t>(code);
    i += length;
  }
  return result;
}

/// The functions used of both libraries.
struct Fonts::Functions {
  decltype(&FT_Init_FreeType) init_freetype = nullptr;
  decltype(&FT_Done_FreeType) done_freetype = nullptr;
  decltype(&FT_New_Face) new_face = nullptr;
  decltype(&FT_Set_Pixel_Sizes) set_pixel_sizes = nullptr;
  decltype(&FT_Load_Char) load_char = nullptr;

  decltype(&FcInitLoadConfigAndFonts) load_config = nullptr;
  decltype(&FcConfigDestroy) destroy_config = nullptr;
  decltype(&FcPatternCreate) create_pattern = nullptr;
  decltype(&FcPatternDestroy) destroy_pattern = nullptr;
  decltype(&FcPatternAddString) add_string = nullptr;
  decltype(&FcConfigSubstitute) substitute = nullptr;
  decltype(&FcDefaultSubstitute) default_substitute = nullptr;
  decltype(&FcFontSort) sort = nullptr;
  decltype(&FcFontSetDestroy) destroy_set = nullptr;
  decltype(&FcPatternGetString) get_string = nullptr;
  decltype(&FcPatternGetInteger) get_integer = nullptr;
  decltype(&FcPatternGetBool) get_bool = nullptr;
  decltype(&FcPatternGetCharSet) get_char_set = nullptr;
  decltype(&FcCharSetHasChar) has_char = nullptr;

  Functions() {
    const SharedLibrary freetype("FreeType", {"libfreetype.so.6"}, "libfreetype6");
    freetype.fetch("FT_Init_FreeType", init_freetype);
    freetype.fetch("FT_Done_FreeType", done_freetype);
    freetype.fetch("FT_New_Face", new_face);
    freetype.fetch("FT_Set_Pixel_Sizes", set_pixel_sizes);
    freetype.fetch("FT_Load_Char", load_char);
    const SharedLibrary fontconfig("fontconfig", {"libfontconfig.so.1"}, "libfontconfig1");
    fontconfig.fetch("FcInitLoadConfigAndFonts", load_config);
    fontconfig.fetch("FcConfigDestroy", destroy_config);
    fontconfig.fetch("FcPatternCreate", create_pattern);
    fontconfig.fetch("FcPatternDestroy", destroy_pattern);
    fontconfig.fetch("FcPatternAddString", add_string);
    fontconfig.fetch("FcConfigSubstitute", substitute);
    fontconfig.fetch("FcDefaultSubstitute", default_substitute);
    fontconfig.fetch("FcFontSort", sort);
    fontconfig.fetch("FcFontSetDestroy", destroy_set);
    fontconfig.fetch("FcPatternGetString", get_string);
    fontconfig.fetch("FcPatternGetInteger", get_integer);
    fontconfig.fetch("FcPatternGetBool", get_bool);
    fontconfig.fetch("FcPatternGetCharSet", get_char_set);
    fontconfig.fetch("FcCharSetHasChar", has_char);
  }
};

struct Fonts::Implementation {
  Functions call;
  FcConfig* config = nullptr;
  FcFontSet* sorted = nullptr;
  FT_Library library = nullptr;
  std::map<int, FT_Face> faces;  // of the used fonts, by their index in `sorted`
  std::map<std::pair<char32_t, int>, Glyph> glyphs;

  Implementation() = default;
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  ~Implementation() {
    if (library != nullptr) call.done_freetype(library);  // frees its faces as well
    if (sorted != nullptr) call.destroy_set(sorted);
    if (config != nullptr) call.destroy_config(config);
  }

  void find_fonts() {
    config = call.load_config();
    FcPattern* const wanted = call.create_pattern();
    const auto add = [&](const char* key, const char* value) {
      call.add_string(wanted, key, reinterpret_cast<const FcChar8*>(value));
    };
    add(FC_FAMILY, "sans-serif");
    add(FC_LANG, "en");  // not the user's language: equal fonts on equal installations
    call.substitute(config, wanted, FcMatchPattern);
    call.default_substitute(wanted);
    FcResult result{};
    sorted = call.sort(config, wanted, FcTrue, nullptr, &result);
    call.destroy_pattern(wanted);
    if (call.init_freetype(&library) != 0) throw OutputError("cannot draw: FreeType does not start");
  }

  /// Returns the index in `sorted` of the first font with the character; -1: none.
  [[nodiscard]] int font_of(char32_t character) const {
    for (int i = 0; sorted != nullptr && i < sorted->nfont; ++i) {
      FcPattern* const font = sorted->fonts[i];
      FcBool scalable = FcFalse;
      FcCharSet* letters = nullptr;
      if (call.get_bool(font, FC_SCALABLE, 0, &scalable) != FcResultMatch || scalable == FcFalse) continue;
      if (call.get_char_set(font, FC_CHARSET, 0, &letters) != FcResultMatch) continue;
      if (call.has_char(letters, static_cast<FcChar32>(character)) != FcFalse) return i;
    }
    return -1;
  }

  [[nodiscard]] std::string text(int font, const char* key) const {
    FcChar8* value = nullptr;
    if (call.get_string(sorted->fonts[font], key, 0, &value) != FcResultMatch) return {};
    return reinterpret_cast<const char*>(value);
  }

  FT_Face face(int font) {
    if (const auto known = faces.find(font); known != faces.end()) return known->second;
    const std::string file = text(font, FC_FILE);
    int index = 0;
    call.get_integer(sorted->fonts[font], FC_INDEX, 0, &index);
    FT_Face made = nullptr;
    if (call.new_face(library, file.c_str(), index, &made) != 0) {
      throw OutputError(fmt::format("cannot draw: the font {} cannot be read", file));
    }
    return faces.emplace(font, made).first->second;
  }

  Glyph draw(char32_t character, int size) {
    FT_Face const from = face(std::max(0, font_of(character)));
    Glyph glyph;
    // Light hinting moves letters only vertically, so widths stay those of the font.
    if (call.set_pixel_sizes(from, 0, static_cast<FT_UInt>(size)) != 0 ||
        call.load_char(from, character, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) != 0) {
      throw OutputError(
          fmt::format("cannot draw: a font has no usable picture of U+{:04X}", static_cast<std::uint32_t>(character)));
    }
    const FT_GlyphSlot slot = from->glyph;
    const FT_Bitmap& bitmap = slot->bitmap;
    glyph.left = slot->bitmap_left;
    glyph.top = slot->bitmap_top;
    glyph.advance = static_cast<double>(slot->advance.x) / 64;
    if (bitmap.pixel_mode != FT_PIXEL_MODE_GRAY) return glyph;  // a space
    glyph.width = static_cast<int>(bitmap.width);
    glyph.height = static_cast<int>(bitmap.rows);
    for (int y = 0; y < glyph.height; ++y) {
      const unsigned char* row = bitmap.buffer + static_cast<std::ptrdiff_t>(y) * bitmap.pitch;
      glyph.coverage.insert(glyph.coverage.end(), row, row + glyph.width);
    }
    return glyph;
  }
};

const char* Fonts::packages() { return "libfreetype6 libfontconfig1 fonts-dejavu-core fonts-droid-fallback"; }

Fonts::Fonts() : implementation_(std::make_unique<Implementation>()) {
  implementation_->find_fonts();
  if (implementation_->font_of(U'a') >= 0) return;
  throw OutputError(
      fmt::format("cannot draw text: no font is found; on Debian: apt-get install fonts-dejavu-core "
                  "(and fonts-droid-fallback for Chinese)"));
}
Fonts::~Fonts() = default;

const Glyph& Fonts::glyph(char32_t character, int size) {
  auto& glyphs = implementation_->glyphs;
  const auto known = glyphs.find({character, size});
  if (known != glyphs.end()) return known->second;
  return glyphs.emplace(std::pair(character, size), implementation_->draw(character, size)).first->second;
}

void Fonts::require(std::string_view text) {
  std::string missing;
  for (const char32_t c : characters(text)) {
    if (c != U'\n' && c != U'\t' && implementation_->font_of(c) < 0 && missing.find(utf8(c)) == std::string::npos) {
      missing += fmt::format("{}'{}' (U+{:04X})", missing.empty() ? "" : ", ", utf8(c), static_cast<std::uint32_t>(c));
    }
  }
  if (missing.empty()) return;
  throw OutputError(
      fmt::format("cannot draw text: no font has {}; on Debian fonts-dejavu-core has Greek and mathematical signs, "
                  "fonts-droid-fallback has Chinese, Japanese and Korean",
                  missing));
}

std::string Fonts::source(char32_t character) {
  const int font = implementation_->font_of(character);
  if (font < 0) return {};
  return fmt::format("{} ({})", implementation_->text(font, FC_FAMILY), implementation_->text(font, FC_FILE));
}

}  // namespace drape
