#include "drape/render/overlay/pen.hpp"

#include <fmt/format.h>
#include <fontconfig/fontconfig.h>
#include <ft2build.h>

#include FT_FREETYPE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/render/image.hpp"

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

namespace {

/// Returns the linear light of each sRGB byte.
const std::array<float, 256>& light_of_bytes() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> light{};
    for (std::size_t i = 0; i < light.size(); ++i) {
      light[i] = static_cast<float>(srgb_to_linear(static_cast<double>(i) / 255));
    }
    return light;
  }();
  return table;
}

/// Returns the index of a pixel in rows of the given width.
std::size_t place(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

/// Blends a colour over a pixel.
/// @param part covered fraction of the pixel
void blend(Image& image, int x, int y, const Eigen::Vector3f& light, float part) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height || part <= 0) return;
  std::uint8_t* const pixel = image.at(x, y);
  for (Eigen::Index c = 0; c < 3; ++c) {
    const double mixed = std::lerp(light_of_bytes()[pixel[c]], light[c], std::min(part, 1.0F));
    pixel[c] = static_cast<std::uint8_t>(std::lround(255 * linear_to_srgb(std::clamp(mixed, 0.0, 1.0))));
  }
}

/// Squared distance transform: replaces each f(q) by the least (p − q)² + f(p), the lower envelope of parabolas (P.
/// Felzenszwalb and D. Huttenlocher 2012, Distance Transforms of Sampled Functions, algorithm 1).
class SquaredDistances {
 public:
  explicit SquaredDistances(int longest)
      : values_(static_cast<std::size_t>(longest)), centres_(values_.size()), begins_(values_.size() + 1) {}

  /// @param stride distance between the `count` numbers
  void along(double* f, std::size_t count, std::size_t stride) {
    for (std::size_t q = 0; q < count; ++q) values_[q] = f[q * stride];
    std::size_t last = 0;
    centres_[0] = 0;
    begins_[0] = -std::numeric_limits<double>::infinity();
    for (std::size_t q = 1; q < count; ++q) {
      double begin = meet(q, centres_[last]);
      while (begin <= begins_[last]) begin = meet(q, centres_[--last]);
      centres_[++last] = q;
      begins_[last] = begin;
    }
    begins_[last + 1] = std::numeric_limits<double>::infinity();
    for (std::size_t q = 0, k = 0; q < count; ++q) {
      while (begins_[k + 1] < static_cast<double>(q)) ++k;
      const double away = static_cast<double>(q) - static_cast<double>(centres_[k]);
      f[q * stride] = away * away + values_[centres_[k]];
    }
  }

  static constexpr double far = 1e12;  // exceeds every squared distance in a picture

 private:
  /// Returns the position where the parabola around q > p falls below the one around p.
  [[nodiscard]] double meet(std::size_t q, std::size_t p) const {
    const auto at_q = static_cast<double>(q), at_p = static_cast<double>(p);
    return (values_[q] - values_[p] + at_q * at_q - at_p * at_p) / (2 * (at_q - at_p));
  }

  std::vector<double> values_;
  std::vector<std::size_t> centres_;  // of the envelope's parabolas
  std::vector<double> begins_;        // start of each parabola's part
};

/// Returns each pixel's distance from the letters; a partly covered pixel is as far away as its uncovered fraction.
std::vector<double> distances_from(const std::vector<float>& coverage, int width, int height) {
  std::vector<double> distances(coverage.size());
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    const double left = 1 - coverage[i];
    distances[i] = coverage[i] > 0 ? left * left : SquaredDistances::far;
  }
  SquaredDistances squared(std::max(width, height));
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  for (std::size_t x = 0; x < columns; ++x) squared.along(distances.data() + x, rows, columns);
  for (std::size_t y = 0; y < rows; ++y) squared.along(distances.data() + y * columns, columns, 1);
  for (double& distance : distances) distance = std::sqrt(distance);
  return distances;
}

double luminance(const Rgb& color) {
  return 0.2126 * srgb_to_linear(color.r) + 0.7152 * srgb_to_linear(color.g) + 0.0722 * srgb_to_linear(color.b);
}

}  // namespace

Rgb contrasting(const Rgb& color) {
  constexpr double flare = 0.05;
  const double on_white = (1 + flare) / (luminance(color) + flare), on_black = (luminance(color) + flare) / flare;
  return on_white >= on_black ? Rgb{1, 1, 1} : Rgb{0, 0, 0};
}

int Pen::width(const std::string& line, int size) {
  double at = 0;
  for (const char32_t c : characters(line)) at += fonts_.glyph(c, size).advance;
  return static_cast<int>(std::ceil(at));
}

std::vector<std::string> Pen::wrap(const std::string& text, int size, int width) {
  std::vector<std::string> lines(1);
  const auto fits = [&](const std::string& line) { return this->width(line, size) <= width; };
  const auto add_letters = [&](const std::string& word) {
    for (std::size_t i = 0; i < word.size();) {
      std::size_t end = i + 1;
      while (end < word.size() && (static_cast<unsigned char>(word[end]) & 0xC0U) == 0x80U) ++end;
      const std::string letter = word.substr(i, end - i);
      if (!lines.back().empty() && !fits(lines.back() + letter)) lines.emplace_back();
      lines.back() += letter;
      i = end;
    }
  };
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \t\n", begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (fits(longer)) {
      lines.back() = longer;
    } else {
      if (!lines.back().empty()) lines.emplace_back();
      add_letters(word);
    }
    if (end < text.size() && text[end] == '\n') lines.emplace_back();
    begin = end + 1;
  }
  return lines;
}

Pen::Mask Pen::mask(const std::string& line, int size, int rim) {
  const std::u32string letters = characters(line);
  Mask mask;
  mask.box = {-rim - size, -rim - 2 * size, width(line, size) + 2 * (rim + size), 3 * size + 2 * rim};
  mask.coverage.assign(static_cast<std::size_t>(mask.box.width) * static_cast<std::size_t>(mask.box.height), 0);
  double at = 0;
  for (const char32_t letter : letters) {
    const Glyph& glyph = fonts_.glyph(letter, size);
    const int left = static_cast<int>(std::lround(at)) + glyph.left - mask.box.left, top = -glyph.top - mask.box.top;
    for (int y = 0; y < glyph.height; ++y) {
      for (int x = 0; x < glyph.width; ++x) {
        const int column = left + x, row = top + y;
        if (column < 0 || row < 0 || column >= mask.box.width || row >= mask.box.height) continue;
        float& to = mask.coverage[place(column, row, mask.box.width)];
        to = std::max(to, static_cast<float>(glyph.coverage[place(x, y, glyph.width)]) / 255);
      }
    }
    at += glyph.advance;
  }
  return mask;
}

// Coverage falls with the distance from the letters: full beside them, zero at the radius.
Pen::Mask Pen::widened(const Mask& letters, int radius) {
  Mask wide{letters.box, std::vector<float>(letters.coverage.size(), 0)};
  const double reach = radius + 1;
  const std::vector<double> distances = distances_from(letters.coverage, letters.box.width, letters.box.height);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    wide.coverage[i] = static_cast<float>(std::clamp(1.6 * (1 - distances[i] / reach), 0.0, 1.0));
  }
  return wide;
}

void Pen::stamp(Image& image, const Mask& mask, int left, int base, const Rgb& color, float strength) {
  const Eigen::Vector3f light = linear_color(color);
  for (int y = 0; y < mask.box.height; ++y) {
    for (int x = 0; x < mask.box.width; ++x) {
      const float part = mask.coverage[place(x, y, mask.box.width)];
      blend(image, left + mask.box.left + x, base + mask.box.top + y, light, strength * part);
    }
  }
}

void Pen::write(Image& image, int left, int base, const std::string& line, int size, const Rgb& color,
                Backing backing) {
  const int rim = backing == Backing::halo ? std::max(2, size / 7) : 0;
  const Mask letters = mask(line, size, rim);
  if (rim > 0) stamp(image, widened(letters, rim), left, base, contrasting(color), 0.85F);
  stamp(image, letters, left, base, color, 1);
}

void Pen::line(Image& image, double x0, double y0, double x1, double y1, double width, const Rgb& color) {
  const Eigen::Vector3f light = linear_color(color);
  const double reach = width / 2 + 1, dx = x1 - x0, dy = y1 - y0, length2 = dx * dx + dy * dy;
  const auto low = [&](double a, double b) { return static_cast<int>(std::floor(std::min(a, b) - reach)); };
  const auto high = [&](double a, double b) { return static_cast<int>(std::ceil(std::max(a, b) + reach)); };
  for (int y = low(y0, y1); y <= high(y0, y1); ++y) {
    for (int x = low(x0, x1); x <= high(x0, x1); ++x) {
      const double px = x + 0.5 - x0, py = y + 0.5 - y0;
      const double along = length2 > 0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0;
      const double away = std::hypot(px - along * dx, py - along * dy);
      blend(image, x, y, light, static_cast<float>(std::clamp(width / 2 + 0.5 - away, 0.0, 1.0)));
    }
  }
}

void Pen::fill(Image& image, const PictureBox& box, const Rgb& color, double part) {
  const Eigen::Vector3f light = linear_color(color);
  for (int y = box.top; y < box.bottom(); ++y) {
    for (int x = box.left; x < box.right(); ++x) blend(image, x, y, light, static_cast<float>(part));
  }
}

}  // namespace drape
