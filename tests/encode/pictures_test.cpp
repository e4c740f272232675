// PNG files written and read by libpng and JPEG files read by libjpeg, compared with OpenCV's readers.

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include <jpeglib.h>

#include "output/codecs/codecs.hpp"
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

/// Makes a JPEG of a smooth picture.
std::string jpeg_of(const cv::Mat& picture, const std::vector<int>& options) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", picture, bytes, options);
  return std::string(view(bytes));
}

cv::Mat waves(int type) {
  cv::Mat picture(31, 45, CV_8UC3);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const double wave = std::sin(0.2 * x) + std::cos(0.3 * y);
      picture.at<cv::Vec3b>(y, x) = cv::Vec3b(static_cast<std::uint8_t>(120 + 50 * wave),
                                              static_cast<std::uint8_t>(5 * x), static_cast<std::uint8_t>(8 * y));
    }
  }
  if (type == CV_8UC1) cv::extractChannel(picture, picture, 0);
  return picture;
}

/// Returns a JPEG with an Exif segment that says how it lies, in either order of bytes.
std::string with_orientation(const std::string& jpeg, int orientation, bool little) {
  const auto bytes = [&](std::uint32_t value, int count) {
    std::string text = number(value).substr(4 - static_cast<std::size_t>(count));
    if (little) std::reverse(text.begin(), text.end());
    return text;
  };
  std::string exif("Exif\0\0", 6);
  exif += (little ? "II" : "MM") + bytes(42, 2) + bytes(8, 4) + bytes(1, 2);
  exif +=
      bytes(0x0112, 2) + bytes(3, 2) + bytes(1, 4) + bytes(static_cast<std::uint32_t>(orientation), 2) + bytes(0, 2);
  exif += bytes(0, 4);
  const auto size = static_cast<std::uint32_t>(exif.size() + 2);
  return jpeg.substr(0, 2) + "\xFF\xE1" + number(size).substr(2) + exif + jpeg.substr(2);
}

TEST(Jpeg, ReadsEveryKindAsOpenCVDoes) {
  for (const int type : {CV_8UC3, CV_8UC1}) {
    for (const std::vector<int>& options :
         {std::vector<int>{}, {cv::IMWRITE_JPEG_PROGRESSIVE, 1}, {cv::IMWRITE_JPEG_QUALITY, 20}}) {
      const std::string jpeg = jpeg_of(waves(type), options);
      ASSERT_TRUE(is_jpeg(jpeg));
      EXPECT_TRUE(equal(decode_picture(jpeg, cv::IMREAD_COLOR), codecs().decode(jpeg, cv::IMREAD_COLOR)));
      for (int orientation = 0; orientation <= 9; ++orientation) {
        const std::string turned = with_orientation(jpeg, orientation, orientation % 2 == 0);
        for (const int flags : {int{cv::IMREAD_COLOR}, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION}) {
          EXPECT_TRUE(equal(decode_picture(turned, flags), codecs().decode(turned, flags))) << orientation;
        }
      }
    }
  }
}

/// Makes a JPEG of four inks, stored inverted as Adobe's programs do: all black of `black`, and red, green or blue
/// light.
std::string jpeg_of_inks(int red, int green, int blue, int black) {
  jpeg_compress_struct info;
  jpeg_error_mgr errors;
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &bytes, &size);
  info.image_width = info.image_height = 16;
  info.input_components = 4;
  info.in_color_space = JCS_CMYK;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 100, TRUE);
  jpeg_start_compress(&info, TRUE);
  std::vector<JSAMPLE> row;
  for (int i = 0; i < 16; ++i) {
    for (const int ink : {red, green, blue, black}) row.push_back(static_cast<JSAMPLE>(ink));
  }
  JSAMPROW line = row.data();
  for (int i = 0; i < 16; ++i) jpeg_write_scanlines(&info, &line, 1);
  jpeg_finish_compress(&info);
  jpeg_destroy_compress(&info);
  std::string jpeg(reinterpret_cast<const char*>(bytes), size);
  std::free(bytes);
  return jpeg;
}

TEST(Jpeg, ReadsInks) {
  for (const auto& [red, green, blue, black] :
       {std::array{255, 255, 255, 255}, {255, 255, 255, 0}, {200, 100, 50, 255}, {200, 100, 50, 128}}) {
    const std::string jpeg = jpeg_of_inks(red, green, blue, black);
    const cv::Mat picture = bgr_from_jpeg(jpeg, true);
    ASSERT_EQ(picture.size(), cv::Size(16, 16));
    const auto color = picture.at<cv::Vec3b>(8, 8);
    EXPECT_NEAR(color[0], blue * black / 255.0, 2);
    EXPECT_NEAR(color[1], green * black / 255.0, 2);
    EXPECT_NEAR(color[2], red * black / 255.0, 2);
    EXPECT_LE(cv::norm(picture, codecs().decode(jpeg, cv::IMREAD_COLOR), cv::NORM_INF), 2);
  }
}

TEST(Jpeg, IsUprightRgbWithThreeColoursAndNoTurn) {
  const std::string rgb = jpeg_of(waves(CV_8UC3), {});
  EXPECT_TRUE(is_upright_rgb_jpeg(rgb));
  for (int orientation = 0; orientation <= 9; ++orientation) {
    const bool turned = orientation >= 2 && orientation <= 8;
    EXPECT_NE(is_upright_rgb_jpeg(with_orientation(rgb, orientation, true)), turned) << orientation;
  }
  EXPECT_FALSE(is_upright_rgb_jpeg(jpeg_of(waves(CV_8UC1), {})));
  EXPECT_FALSE(is_upright_rgb_jpeg(jpeg_of_inks(200, 100, 50, 128)));
  EXPECT_FALSE(is_upright_rgb_jpeg(rgb.substr(0, 20)));
  EXPECT_FALSE(is_upright_rgb_jpeg(""));
}

TEST(Jpeg, OfWhatIsCutThereIsNoPicture) {
  const std::string jpeg = with_orientation(jpeg_of(waves(CV_8UC3), {}), 6, true);
  ::testing::internal::CaptureStderr();
  for (std::size_t size = 0; size < jpeg.size(); ++size) {
    EXPECT_TRUE(bgr_from_jpeg(std::string_view(jpeg).substr(0, size), true).empty()) << size;
  }
  Random random(11);
  for (int i = 0; i < 1000; ++i) {
    std::string damaged = jpeg;
    for (int k = random.below(4); k >= 0; --k) {
      damaged[static_cast<std::size_t>(random.below(static_cast<int>(damaged.size())))] =
          static_cast<char>(random.below(256));
    }
    bgr_from_jpeg(damaged, true);  // libjpeg mends what it can
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace drape
