#include "check/name_difference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace drape::name_difference_test {
namespace {

constexpr int width = 120, height = 90;

/// Returns soft waves of two colours on white, shifted by a fraction of a pixel.
Image waves(double dx, double dy, double brightness = 1) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = x - dx, v = y - dy;
      const double a = 0.5 + 0.5 * std::sin(0.21 * u) * std::cos(0.17 * v), b = 0.5 + 0.5 * std::sin(0.1 * (u + v));
      const std::array<double, 3> color{60 + 120 * a, 40 + 90 * b, 50 + 40 * a * b};
      for (std::size_t c = 0; c < 3; ++c) {
        image.at(x, y)[c] = static_cast<std::uint8_t>(std::lround(brightness * color[c]));
      }
    }
  }
  return image;
}

TEST(NameDifference, SaysNothingOfTheSamePicture) { EXPECT_EQ(classify_difference(waves(0, 0), waves(0, 0)), ""); }

TEST(NameDifference, NamesAShift) {
  EXPECT_EQ(classify_difference(waves(0, 0), waves(3, 0)), "a shift by 3 pixels to the right");
  EXPECT_EQ(classify_difference(waves(0, 0), waves(0, -2)), "a shift by 2 pixels up");
  const std::string half = classify_difference(waves(0, 0), waves(-0.5, 0.5));
  EXPECT_TRUE(half.starts_with("a shift by 0.")) << half;
  EXPECT_NE(half.find(" pixels to the left and 0."), std::string::npos) << half;
  EXPECT_TRUE(half.ends_with(" pixels down")) << half;
}

TEST(NameDifference, NamesABrightness) {
  EXPECT_EQ(classify_difference(waves(0, 0), waves(0, 0, 1.05)), "a brightness 5 % higher");
  EXPECT_EQ(classify_difference(waves(0, 0), waves(0, 0, 0.9)), "a brightness 10 % lower");
}

TEST(NameDifference, NamesOtherColours) {
  Image swapped = waves(0, 0);
  for (std::size_t i = 0; i < swapped.pixels.size(); i += 3) std::swap(swapped.pixels[i], swapped.pixels[i + 2]);
  EXPECT_EQ(classify_difference(waves(0, 0), swapped), "different colours in the same places");
}

TEST(NameDifference, NamesAPlace) {
  Image dot = waves(0, 0);
  for (int y = 20; y < 24; ++y) {
    for (int x = 70; x < 76; ++x) dot.at(x, y)[1] = 250;
  }
  EXPECT_EQ(classify_difference(waves(0, 0), dot), "one place only: 6x4 pixels at column 70, row 20");
}

TEST(NameDifference, NamesEdges) {
  // Stripes with a soft edge at a different position in every row.
  const auto stripes = [](bool jagged) {
    Image image(width, height);
    for (int y = 0; y < height; ++y) {
      const int edge = jagged ? 70 + 40 * (y * y % 5) : 130;
      for (int x = 0; x < width; ++x) {
        const int value = x % 30 < 15 ? 40 : x % 30 == 15 ? edge : 220;
        for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<std::uint8_t>(value);
      }
    }
    return image;
  };
  EXPECT_EQ(classify_difference(stripes(false), stripes(true)), "edges only: of lines, outlines or a texture");
}

TEST(NameOtherMachine, TellsWhatMattersOnly) {
  const Machine here{"1.0", "GNU 12", "Linux", "a processor", "avx2", "avx2", "llvmpipe 15"};
  Machine there = here;
  EXPECT_EQ(name_other_machine(there, here), "");
  there.system = "another Linux";
  EXPECT_EQ(name_other_machine(there, here), "");
  there.renderer = "llvmpipe 17";
  there.kernels = "sse2";
  EXPECT_EQ(name_other_machine(there, here),
            "with a different renderer (llvmpipe 17; here llvmpipe 15), a different instruction set (sse2; here avx2)");
}

}  // namespace
}  // namespace drape::name_difference_test
