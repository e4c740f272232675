#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "output/gif/compactor.hpp"
#include "output/gif/palette.hpp"
#include "tests/support/synthetic_film.hpp"

using namespace drape;

namespace {

using Bytes = std::vector<std::uint8_t>;

/// Makes an image of distinct colours, with a share of evenly scattered pixels of one colour.
Image noise_with(std::uint32_t color, int percent, std::uint32_t seed) {
  Image image(100, 100);
  std::mt19937 random(seed);
  for (int i = 0; i < 10000; ++i) {
    const std::uint32_t value = i * 37 % 100 < percent ? color : random() & 0xffffff;
    for (int c = 0; c < 3; ++c) image.pixels[3 * i + c] = static_cast<std::uint8_t>(value >> (16 - 8 * c));
  }
  return image;
}

TEST(FrameDifference, GivesBackTheFrame) {
  std::mt19937 random(1);
  for (const int size : {0, 1, 7, 8, 9, 100, 4099}) {
    for (int changes = 0; changes <= size; changes = 2 * changes + 1) {
      Bytes before(static_cast<std::size_t>(size)), now, packed{1, 2, 3};
      for (std::uint8_t& byte : before) byte = static_cast<std::uint8_t>(random());
      now = before;
      for (int i = 0; i < changes; ++i) now[random() % now.size()] ^= static_cast<std::uint8_t>(random());
      gif::pack_difference(before, now, packed);
      EXPECT_LE(packed.size(), now.size() + now.size() / 2 + 8);
      Bytes frame = before;
      EXPECT_TRUE(gif::apply_difference(packed, frame));
      EXPECT_EQ(frame, now) << size << " bytes, " << changes << " changes";
    }
  }
}

TEST(FrameDifference, RefusesThatOfAnotherSizeAndWhatIsCutOff) {
  const Bytes before(100, 1), now(100, 2);
  Bytes packed, shorter(99), longer(101), frame(100);
  gif::pack_difference(before, now, packed);
  EXPECT_FALSE(gif::apply_difference(packed, shorter));
  EXPECT_FALSE(gif::apply_difference(packed, longer));
  for (std::size_t size = 0; size < packed.size(); ++size) {
    EXPECT_FALSE(gif::apply_difference(std::span(packed).first(size), frame)) << size;
  }
}

TEST(ColorHistogram, CountsEveryColorOnce) {
  gif::ColorHistogram histogram;
  std::map<std::uint32_t, std::uint64_t> expected;
  for (const Image& image : {test::synthetic_frame(0, 97, 61), test::synthetic_frame(9, 97, 61)}) {
    histogram.add(image);
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) ++expected[gif::rgb_number(&image.pixels[i])];
  }
  std::map<std::uint32_t, std::uint64_t> found;
  for (const gif::ColorCount& c : histogram.colors()) EXPECT_TRUE(found.emplace(c.color, c.count).second);
  EXPECT_EQ(found, expected);
}

TEST(ColorCut, KeepsFewColorsAsTheyAre) {
  std::vector<gif::ColorCount> colors;
  std::vector<std::uint32_t> expected;
  for (std::uint32_t i = 0; i < 200; ++i) {
    expected.push_back(i * 0x010305);
    colors.push_back({expected.back(), 1 + i * i});
  }
  EXPECT_EQ(gif::representative_colors(colors, 200), expected);
}

TEST(ColorCut, FindsTheMeansOfClustersFarApart) {
  // Two levels on each side of a centre, with equal numbers of pixels.
  std::vector<gif::ColorCount> colors;
  std::set<std::uint32_t> centers;
  for (std::uint32_t r = 0; r < 3; ++r) {
    for (std::uint32_t g = 0; g < 3; ++g) {
      const std::uint32_t center = (20 + 100 * r) << 16 | (20 + 100 * g) << 8 | 50;
      centers.insert(center);
      for (const std::uint32_t offset : {0x020000u, 0x000200u, 0x000002u}) {
        colors.push_back({center + offset, 5 + r});
        colors.push_back({center - offset, 5 + r});
      }
    }
  }
  const std::vector<std::uint32_t> found = gif::representative_colors(colors, centers.size());
  EXPECT_EQ(std::set<std::uint32_t>(found.begin(), found.end()), centers);
}

TEST(GifPalette, HoldsAColorOfSixPercentOfNoiseExactly) {
  gif::ColorHistogram histogram;
  for (std::uint32_t k = 0; k < 20; ++k) histogram.add(noise_with(0xfefdfc, 6, k));
  const gif::Palette palette = gif::make_palette(histogram);
  EXPECT_EQ(palette.exact, std::vector<std::uint32_t>{0xfefdfc});
  EXPECT_EQ(std::count(palette.colors.begin() + 1, palette.colors.end(), 0xfefdfcu), 1);
}

TEST(GifPalette, HoldsNoColorOfNoiseExactly) {
  gif::ColorHistogram histogram;
  for (std::uint32_t k = 0; k < 20; ++k) histogram.add(noise_with(0, 0, k));
  EXPECT_TRUE(gif::make_palette(histogram).exact.empty());
}

TEST(GifPalette, GivesAHueThatFewFramesShowColorsOfItsOwn) {
  // A film of many grey and yellow shades, in which 3 of 10 000 pixels are a shaded red.
  gif::ColorHistogram histogram;
  std::mt19937 random(1);
  Image image(1000, 1000);
  std::set<std::uint32_t> reds;
  for (std::size_t i = 0; i < 1'000'000; ++i) {
    std::uint8_t* pixel = &image.pixels[3 * i];
    const auto shade = static_cast<std::uint8_t>(30 + random() % 200);
    if (i < 300) {
      pixel[0] = shade, pixel[1] = pixel[2] = static_cast<std::uint8_t>(shade / 8);
      reds.insert(gif::rgb_number(pixel));
    } else {
      pixel[0] = shade;
      pixel[1] = static_cast<std::uint8_t>(shade * 3 / 4 + random() % 8);
      pixel[2] = static_cast<std::uint8_t>(i % 2 == 0 ? shade : random() % 16);
    }
  }
  histogram.add(image);
  const gif::Palette palette = gif::make_palette(histogram);
  // 200 levels are covered by 16 colours or more: none is farther off than half of the gap between two of them.
  for (const std::uint32_t color : reds) {
    int least = 256;
    for (std::size_t i = 1; i < palette.colors.size(); ++i) {
      const std::uint32_t p = palette.colors[i];
      least = std::min(least,
                       std::max({std::abs(gif::red(p) - gif::red(color)), std::abs(gif::green(p) - gif::green(color)),
                                 std::abs(gif::blue(p) - gif::blue(color))}));
    }
    EXPECT_LE(least, 200 / 16) << std::hex << color;
  }
}

// A dither with the amplitude of the palette's gap mixes the two colours around a colour in proportion, and uses no
// other.
TEST(OrderedDither, MixesTheTwoColorsAroundEach) {
  constexpr int gap = 6, size = 64;
  gif::Palette palette;
  for (std::size_t i = 1; i < palette.colors.size(); ++i) {
    palette.colors[i] = 0x010101 * std::min<std::uint32_t>(static_cast<std::uint32_t>(gap * i), 255);
  }
  for (int gray = 60; gray < 60 + gap; ++gray) {
    Image image(size, size);
    std::ranges::fill(image.pixels, static_cast<std::uint8_t>(gray));
    gif::OrderedDither dither(palette, size, size);
    double sum = 0;
    for (const std::uint8_t index : dither.apply(image).index) {
      const int shown = static_cast<int>(palette.colors[index] & 0xff);
      EXPECT_LT(std::abs(shown - gray), gap);
      sum += shown;
    }
    EXPECT_NEAR(sum / (size * size), gray, 1);
  }
}

}  // namespace
