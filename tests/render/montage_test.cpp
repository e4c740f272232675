#include "drape/render/image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace drape {
namespace {

Image filled(int width, int height, std::uint8_t gray) {
  Image image(width, height);
  std::fill(image.pixels.begin(), image.pixels.end(), gray);
  return image;
}

TEST(Montage, PutsPicturesInRowsWithAGapBetween) {
  const Image a = filled(3, 2, 10), b = filled(3, 2, 20), c = filled(3, 2, 30);
  const Image all = montage({&a, &b, &c}, 2, 1, 99);
  EXPECT_EQ(all.width, 7);
  EXPECT_EQ(all.height, 5);
  EXPECT_EQ(*all.at(0, 0), 10);
  EXPECT_EQ(*all.at(2, 1), 10);
  EXPECT_EQ(*all.at(3, 0), 99);
  EXPECT_EQ(*all.at(4, 0), 20);
  EXPECT_EQ(*all.at(0, 2), 99);
  EXPECT_EQ(*all.at(0, 3), 30);
  EXPECT_EQ(*all.at(6, 4), 99);
  EXPECT_EQ(montage({&a}, 3, 5, 0), a);
}

TEST(Montage, RefusesPicturesOfDifferentSizes) {
  const Image a = filled(3, 2, 0), b = filled(2, 2, 0);
  EXPECT_THROW(montage({&a, &b}, 2, 0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace drape
