// PNG files written and read by libpng, compared with OpenCV's reader.

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "output/codecs/codecs.hpp"
#include "output/codecs/png.hpp"
#include "tests/support/random.hpp"

namespace drape {
namespace {

using test::Random;

bool equal(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && std::equal(a.datastart, a.dataend, b.datastart);
}

cv::Mat noise(int width, int height, Random& random) {
  cv::Mat picture(height, width, CV_8UC3);
  for (std::size_t i = 0; i < 3 * picture.total(); ++i) picture.data[i] = static_cast<std::uint8_t>(random.below(256));
  return picture;
}

std::string_view view(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(Png, GivesBackWhatItWasMadeOf) {
  Random random(3);
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {64, 48}, {1, 300}}) {
    const cv::Mat picture = noise(width, height, random);
    const std::vector<std::uint8_t> png = png_from_bgr(picture);
    EXPECT_TRUE(is_png(view(png)));
    EXPECT_TRUE(equal(bgr_from_png(view(png)), picture));
    EXPECT_TRUE(equal(codecs().decode(view(png), cv::IMREAD_COLOR), picture));
    EXPECT_EQ(png_from_bgr(picture), png);
  }
}

std::string number(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255U);
  return bytes;
}

std::string chunk(const std::string& kind, const std::string& data) {
  const std::string body = kind + data;
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return number(static_cast<std::uint32_t>(data.size())) + body + number(static_cast<std::uint32_t>(sum));
}

/// Makes a PNG of noise, of one of the format's kinds.
std::string png_of_kind(int color, int bits, Random& random) {
  constexpr int width = 13, height = 5;
  const int channels = std::array{1, 0, 3, 1, 2, 0, 4}[static_cast<std::size_t>(color)];
  std::string rows;
  for (int row = 0; row < height; ++row) {
    rows += '\0';  // no filter
    for (int i = 0; i < (width * channels * bits + 7) / 8; ++i) rows += static_cast<char>(random.below(256));
  }
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
           static_cast<uLong>(rows.size()));
  packed.resize(size);
  std::string png("\x89PNG\r\n\x1a\n", 8);
  png += chunk("IHDR", number(width) + number(height) + static_cast<char>(bits) + static_cast<char>(color) +
                           std::string(3, '\0'));
  if (color == 3) {
    std::string palette;
    for (int i = 0; i < 3 << bits; ++i) palette += static_cast<char>(random.below(256));
    png += chunk("PLTE", palette) + chunk("tRNS", std::string(1, '\x40'));
  }
  return png + chunk("IDAT", packed) + chunk("IEND", "");
}

TEST(Png, ReadsEveryKindAsOpenCVDoes) {
  Random random(5);
  for (const auto& [color, bits] : {std::pair{0, 1},
                                    {0, 2},
                                    {0, 4},
                                    {0, 8},
                                    {0, 16},
                                    {2, 8},
                                    {2, 16},
                                    {3, 1},
                                    {3, 4},
                                    {3, 8},
                                    {4, 8},
                                    {4, 16},
                                    {6, 8},
                                    {6, 16}}) {
    const std::string png = png_of_kind(color, bits, random);
    const cv::Mat picture = bgr_from_png(png);
    ASSERT_FALSE(picture.empty()) << color << ", " << bits;
    EXPECT_TRUE(equal(picture, codecs().decode(png, cv::IMREAD_COLOR))) << color << ", " << bits;
  }
}

// Damaged files give no partial picture, and nothing is printed.
TEST(Png, OfWhatIsDamagedThereIsNoPicture) {
  Random random(7);
  const std::vector<std::uint8_t> bytes = png_from_bgr(noise(20, 20, random));
  ::testing::internal::CaptureStderr();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_TRUE(bgr_from_png(view(bytes).substr(0, size)).empty()) << size;
  }
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> damaged = bytes;
    for (int k = random.below(4); k >= 0; --k) {
      damaged[static_cast<std::size_t>(random.below(static_cast<int>(damaged.size())))] =
          static_cast<std::uint8_t>(random.below(256));
    }
    const cv::Mat picture = bgr_from_png(view(damaged));  // another size is possible; whole if the byte is unchanged
    if (damaged == bytes) {
      EXPECT_FALSE(picture.empty());
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace drape
