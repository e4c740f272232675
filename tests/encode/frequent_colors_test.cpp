#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "output/frequent_colors.hpp"

using namespace drape;

namespace {

/// Every pixel has a colour of its own, but for the share of one colour, strewn evenly.
Image noise_with(std::uint32_t color, int percent, std::uint32_t seed) {
  Image image(100, 100);
  std::mt19937 random(seed);
  for (int i = 0; i < 10000; ++i) {
    const std::uint32_t value = i * 37 % 100 < percent ? color : random() & 0xffffff;
    for (int c = 0; c < 3; ++c) image.pixels[3 * i + c] = static_cast<std::uint8_t>(value >> (16 - 8 * c));
  }
  return image;
}

TEST(FrequentColors, FindsAColorThatCoversSixPercentOfNoise) {
  FrequentColors frequent;
  for (std::uint32_t k = 0; k < 20; ++k) frequent.add(noise_with(0xfefdfc, 6, k));
  EXPECT_EQ(frequent.colors(), std::vector<std::uint32_t>{0xfefdfc});
}

TEST(FrequentColors, FindsNoneInNoise) {
  FrequentColors frequent;
  for (std::uint32_t k = 0; k < 20; ++k) frequent.add(noise_with(0, 0, k));
  EXPECT_TRUE(frequent.colors().empty());
}

TEST(FrequentColors, FindsAllThatShareAPictureInAscendingOrder) {
  Image image(100, 100);
  std::vector<std::uint32_t> expected;
  for (std::uint32_t i = 0; i < 10; ++i) expected.push_back(0x010203 * (i + 1));
  for (int i = 0; i < 10000; ++i) {
    for (int c = 0; c < 3; ++c)
      image.pixels[3 * i + c] = static_cast<std::uint8_t>(expected[9 - i % 10] >> (16 - 8 * c));
  }
  FrequentColors frequent;
  frequent.add(image);
  EXPECT_EQ(frequent.colors(), expected);
}

}  // namespace
