#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "drape/core/error.hpp"
#include "drape/render/image.hpp"
#include "drape/render/overlay/caption.hpp"
#include "drape/render/overlay/pen.hpp"

namespace drape::overlay_text {
namespace {

Image filled(int width, int height, std::array<std::uint8_t, 3> color) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = color[i % 3];
  return image;
}

double luminance(const std::uint8_t* pixel) {
  return 0.2126 * srgb_to_linear(pixel[0] / 255.0) + 0.7152 * srgb_to_linear(pixel[1] / 255.0) +
         0.0722 * srgb_to_linear(pixel[2] / 255.0);
}

std::string message(const auto& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "(none)";
}

TEST(TextTemplate, FillsFieldsAndKeepsDoubledBraces) {
  const TextTemplate text("{{x}} = {a:.2f} m, {b}, {c:04}, {v:.1f}");
  const std::map<std::string, FieldValue> values{
      {"a", 1.005}, {"b", std::string("liu13")}, {"c", std::int64_t{7}}, {"v", std::vector<double>{1, 2.25}}};
  EXPECT_EQ(text.fill([&](const std::string& name) { return values.at(name); }),
            "{x} = 1.00 m, liu13, 0007, [1.0, 2.2]");
}

TEST(TextTemplate, ShowsNumbersWithoutAFormatInSixDigits) {
  EXPECT_EQ(format_field(7 * 0.04, ""), "0.28");
  EXPECT_EQ(format_field(1e-3, ""), "0.001");
  EXPECT_EQ(format_field(180.0, ""), "180");
  EXPECT_EQ(format_field(std::int64_t{12}, ".1f"), "12.0");
}

TEST(TextTemplate, RefusesWhatIsNoFormat) {
  for (const char* format : {"x?", ".f", "{}", ".2f}", "1234", ".123f", "s", "d"}) {
    EXPECT_THROW(format_field(1.5, format), std::invalid_argument) << format;
  }
  EXPECT_THROW(format_field(std::string("liu13"), ".2f"), std::invalid_argument);
  EXPECT_THROW(format_field(std::int64_t{1}, "s"), std::invalid_argument);
}

TEST(TextTemplate, SaysWhichBraceIsWrong) {
  EXPECT_EQ(message([] { TextTemplate("a {time"); }), "'{time' has no '}'; write '{{' for a brace");
  EXPECT_EQ(message([] { TextTemplate("a } b"); }), "there is a '}' without its '{'; write '}}' for a brace");
  EXPECT_EQ(message([] { TextTemplate("{a{b}}"); }).substr(0, 10), "'{a{b}}' h");
}

TEST(Fonts, HaveGreekTheMicroSignAndChinese) {
  Fonts fonts;
  const Glyph missing = fonts.glyph(U'\U0010FFFD', 32);  // a noncharacter
  for (const char32_t letter : {U'a', U'ε', U'Δ', U'µ', U'中', U'模'}) {
    const Glyph& glyph = fonts.glyph(letter, 32);
    EXPECT_GT(glyph.advance, 0) << static_cast<std::uint32_t>(letter);
    EXPECT_NE(glyph.coverage, missing.coverage) << static_cast<std::uint32_t>(letter);
    EXPECT_FALSE(fonts.source(letter).empty());
  }
  EXPECT_NO_THROW(fonts.require("ε = 10 µm, 布料"));
  EXPECT_THROW(fonts.require("\U0010FFFD"), OutputError);
}

TEST(Fonts, ReadUtf8AndReplaceWhatIsNone) {
  EXPECT_EQ(characters("aε中\U0001F600"), U"aε中\U0001F600");
  EXPECT_EQ(characters("a\xFFz"), U"a\uFFFDz");
}

TEST(Pen, MixesInLinearLight) {
  Image image = filled(4, 4, {0, 0, 0});
  Pen::fill(image, {0, 0, 4, 2}, {1, 1, 1}, 0.5);
  EXPECT_EQ(*image.at(1, 1), 188);  // the sRGB byte of half the light, IEC 61966-2-1
  EXPECT_EQ(*image.at(1, 2), 0);
}

TEST(Pen, ALineCoversItsLengthTimesItsWidth) {
  Image image = filled(80, 80, {0, 0, 0});
  Pen::line(image, 10, 15.3, 60, 52.8, 3, {1, 1, 1});  // 62.5 pixels long, and two half discs
  double covered = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) covered += luminance(image.at(x, y));
  }
  EXPECT_NEAR(covered, 62.5 * 3 + 3.14159 * 1.5 * 1.5, 0.02 * covered);
}

TEST(Pen, LeavesOutWhatIsOutsideThePicture) {
  Pen pen;
  Image image = filled(60, 20, {255, 255, 255});
  const Image blank = image;
  pen.write(image, 200, 10, "outside", 12, {0, 0, 0}, Backing::halo);
  EXPECT_EQ(image, blank);
}

TEST(Pen, ALineOfTextEndsWhereItsWidthSays) {
  Pen pen;
  for (const char* text : {"5 µs a step", "ε = 0.001", "布料"}) {
    Image image = filled(300, 60, {255, 255, 255});
    pen.write(image, 10, 40, text, 24, {0, 0, 0});
    int last = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        if (*image.at(x, y) < 128) last = std::max(last, x);
      }
    }
    EXPECT_NEAR(last, 10 + pen.width(text, 24), 4) << text;
  }
}

TEST(Pen, BreaksLinesAtSpacesOrElseBetweenLetters) {
  Pen pen;
  const std::string text = "one two three four five\nsix 布料布料布料布料布料布料布料布料";
  const std::vector<std::string> lines = pen.wrap(text, 16, 100);
  EXPECT_GT(lines.size(), 4U);
  std::string joined;
  for (const std::string& line : lines) {
    EXPECT_LE(pen.width(line, 16), 100) << line;
    joined += line;
  }
  const auto letters = [](std::string s) { return std::erase_if(s, [](char c) { return c == ' ' || c == '\n'; }), s; };
  EXPECT_EQ(letters(joined), letters(text));
  EXPECT_EQ(pen.wrap("a\n\nb", 16, 100), (std::vector<std::string>{"a", "", "b"}));
}

TEST(Pen, SetsATabAsASpace) {
  Pen pen;
  EXPECT_EQ(pen.wrap("a\tb", 16, 100), std::vector<std::string>{"a b"});
}

/// Returns the least contrast ratio (WCAG 2.1) of the letters with their surroundings.
double least_contrast(const Image& image, const Image& plain, const Rgb& ink, int reach) {
  const std::array<std::uint8_t, 3> letter{static_cast<std::uint8_t>(std::lround(255 * ink.r)),
                                           static_cast<std::uint8_t>(std::lround(255 * ink.g)),
                                           static_cast<std::uint8_t>(std::lround(255 * ink.b))};
  double least = 21;
  for (int y = reach; y < image.height - reach; ++y) {
    for (int x = reach; x < image.width - reach; ++x) {
      if (!std::equal(letter.begin(), letter.end(), image.at(x, y)) ||
          std::equal(letter.begin(), letter.end(), plain.at(x, y))) {
        continue;
      }
      double best = 1;  // of a letter's pixel with one near it
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
          const double a = luminance(image.at(x, y)) + 0.05, b = luminance(image.at(x + dx, y + dy)) + 0.05;
          best = std::max(best, std::max(a, b) / std::min(a, b));
        }
      }
      least = std::min(least, best);
    }
  }
  return least;
}

TEST(Caption, IsReadableOnAnyBackground) {
  Pen pen;
  for (const Backing backing : {Backing::halo, Backing::panel}) {
    for (const std::array<std::uint8_t, 3> behind :
         {std::array<std::uint8_t, 3>{0, 0, 0}, {255, 255, 255}, {128, 128, 128}, {200, 30, 30}, {20, 30, 120}}) {
      for (const Rgb& ink : {Rgb{0, 0, 0}, Rgb{1, 1, 1}}) {
        const Image plain = filled(320, 100, behind);
        Image image = plain;
        CaptionSettings caption;
        caption.size = 24;
        caption.color = ink;
        caption.backing = backing;
        draw_caption(image, pen, caption, "liu13, ε = 0.001", {1, 1, 1});
        EXPECT_GE(least_contrast(image, plain, ink, 4), 4.5) << static_cast<int>(behind[0]) << " " << ink.r;
      }
    }
  }
}

/// Returns true if nothing is written at the edge of an initially white picture.
bool is_framed(const Image& image) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool edge = x == 0 || y == 0 || x + 1 == image.width || y + 1 == image.height;
      if (edge && *image.at(x, y) < 255) return false;
    }
  }
  return true;
}

TEST(Caption, StandsWithinThePicture) {
  Pen pen;
  const std::string word = "Donaudampfschiffahrtsgesellschaft", chinese = "布料布料布料布料布料布料布料";
  for (const auto& [width, height] : {std::pair{64, 64}, std::pair{320, 40}, std::pair{40, 320}, std::pair{640, 480}}) {
    for (const std::string& text : {std::string("t = 0.04 s"), word, chinese, word + "\n" + word}) {
      for (const std::optional<int> size : {std::optional<int>(), std::optional<int>(512), std::optional<int>(20)}) {
        for (int place = 0; place < 6; ++place) {
          Image image = filled(width, height, {255, 255, 255});
          CaptionSettings caption;
          caption.place = static_cast<CaptionPlace>(place);
          caption.size = size;
          if (largest_caption_size(pen, text, 512, width, height) == 0) continue;
          draw_caption(image, pen, caption, text, {1, 1, 1});
          EXPECT_TRUE(is_framed(image)) << width << "x" << height << " " << text << " " << place;
          EXPECT_NE(image, filled(width, height, {255, 255, 255}));
        }
      }
    }
  }
}

TEST(Caption, IsRefusedWithTheLargestSizeThatFits) {
  Pen pen;
  const auto refusal = [&](std::optional<int> size, const std::string& text) {
    CaptionSettings caption;
    caption.size = size;
    try {
      require_room(pen, caption, text, 64, 64);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("(none)");
  };
  const int largest = largest_caption_size(pen, "t = 0.04 s", 512, 64, 64);
  ASSERT_GT(largest, 6);
  EXPECT_EQ(refusal(512, "t = 0.04 s"),
            "a caption of size = 512 does not fit into a picture of 64x64 pixels: the largest that fits is size = " +
                std::to_string(largest));
  EXPECT_EQ(refusal(largest, "t = 0.04 s"), "(none)");
  EXPECT_EQ(refusal({}, "t = 0.04 s"), "(none)");
  EXPECT_EQ(refusal({}, std::string(4096, 'x')),
            "the caption is too long for a picture of 64x64 pixels, even with letters of 6 pixels");
}

// Regression: the rim once took time with the fourth power of the size, for this text more than two minutes.
TEST(Pen, DrawsARimOfAnySize) {
  Pen pen;
  Image image = filled(1600, 700, {255, 255, 255});
  pen.write(image, 100, 560, "rim", 512, {1, 1, 1}, Backing::halo);
  int first = image.width;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (*image.at(x, y) < 250) first = std::min(first, x);
    }
  }
  const Glyph& letter = pen.fonts().glyph(U'r', 512);
  constexpr int rim = 512 / 7;
  EXPECT_NEAR(first, 100 + letter.left - rim, 8);
}

TEST(Pen, ARimIsAsDarkAsItIsNear) {
  Pen pen;
  const int size = 40, rim = size / 7;
  Image letters = filled(120, 80, {0, 0, 0}), rims = filled(120, 80, {255, 255, 255});
  pen.write(letters, 20, 60, "Il", size, {1, 1, 1});
  pen.write(rims, 20, 60, "Il", size, {1, 1, 1}, Backing::halo);
  int checked = 0;
  for (int y = 20; y < 70; ++y) {
    for (int x = 10; x < 100; ++x) {
      double near = 1e9;  // distance to a letter
      for (int v = 0; v < letters.height; ++v) {
        for (int u = 0; u < letters.width; ++u) {
          if (*letters.at(u, v) > 250) near = std::min(near, std::hypot(u - x, v - y));
        }
      }
      if (near < 1.5) continue;
      const double fade = std::clamp(1.6 * (1 - near / (rim + 1)), 0.0, 1.0);
      EXPECT_NEAR(luminance(rims.at(x, y)), 1 - 0.85 * fade, 0.25) << x << " " << y;
      checked += fade > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(checked, 200);
}

TEST(Caption, StandsWhereItIsPlaced) {
  Pen pen;
  for (int place = 0; place < 6; ++place) {
    Image image = filled(300, 200, {255, 255, 255});
    CaptionSettings caption;
    caption.place = static_cast<CaptionPlace>(place);
    caption.size = 16;
    draw_caption(image, pen, caption, "here", {1, 1, 1});
    double x_sum = 0, y_sum = 0, count = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        if (*image.at(x, y) > 128) continue;
        x_sum += x;
        y_sum += y;
        ++count;
      }
    }
    ASSERT_GT(count, 0);
    EXPECT_EQ(y_sum / count > 100, place >= 3) << place;
    const int third = static_cast<int>(x_sum / count / 100);
    EXPECT_EQ(third, place % 3) << place;
  }
}

}  // namespace
}  // namespace drape::overlay_text
