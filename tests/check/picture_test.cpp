#include "check/picture.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "output/png_encoder.hpp"
#include "tests/support/synthetic_film.hpp"

namespace drape::picture {
namespace {

constexpr int width = 100, height = 80;  // 0.5 % are 40 pixels

Image base() { return test::synthetic_frame(0, width, height); }

/// Changes one channel of the first `count` pixels of every other column by `amount`.
Image with_changes(int count, int amount) {
  Image image = base();
  for (int i = 0; i < count; ++i) {
    std::uint8_t& value = image.at(2 * i % width, 2 * i / width)[1];
    value = static_cast<std::uint8_t>(value < 128 ? value + amount : value - amount);
  }
  return image;
}

PictureVerdict verdict(const Image& actual, const PictureLimits& limits = {}) {
  return compare_pictures(base(), actual, limits).difference.verdict;
}

TEST(PictureVerdict, IsExactForTheSameBytesOnly) {
  EXPECT_EQ(verdict(base()), PictureVerdict::exact);
  EXPECT_EQ(verdict(with_changes(1, 1)), PictureVerdict::noise);
}

TEST(PictureVerdict, TakesAFewPixelsThatDifferByLittleForNoise) {
  EXPECT_EQ(verdict(with_changes(40, 1)), PictureVerdict::noise);
  EXPECT_EQ(verdict(with_changes(41, 1)), PictureVerdict::changed);  // more than 0.5 %
}

TEST(PictureVerdict, TakesNoPixelThatDiffersByMoreThanThree) {
  PictureLimits limits;
  limits.flip = 1;
  EXPECT_EQ(verdict(with_changes(1, 3), limits), PictureVerdict::noise);
  EXPECT_EQ(verdict(with_changes(1, 4), limits), PictureVerdict::changed);
}

TEST(PictureVerdict, TakesNoPixelWithAVisibleFlipError) {
  // A visible patch of 6×6 pixels within the limits of channel and number.
  Image patch = base();
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 6; ++x) patch.at(x, y)[2] = static_cast<std::uint8_t>(patch.at(x, y)[2] - 3);
  }
  const PictureDifference found = compare_pictures(base(), patch, {}).difference;
  EXPECT_LE(found.largest_channel, 3);
  EXPECT_LE(found.fraction, 0.005);
  PictureLimits strict;
  strict.flip = 0.9 * found.max_flip;
  EXPECT_EQ(verdict(patch, strict), PictureVerdict::changed);
  strict.flip = 1.1 * found.max_flip;
  EXPECT_EQ(verdict(patch, strict), PictureVerdict::noise);
}

TEST(PictureVerdict, TellsHowMuchAndWhere) {
  Image actual = base();
  actual.at(30, 50)[0] = static_cast<std::uint8_t>(255 - actual.at(30, 50)[0]);
  const int amount = std::abs(base().at(30, 50)[0] - actual.at(30, 50)[0]);
  const PictureComparison found = compare_pictures(base(), actual, {});
  EXPECT_EQ(found.difference.pixels, 1);
  EXPECT_DOUBLE_EQ(found.difference.fraction, 1.0 / (width * height));
  EXPECT_EQ(found.difference.largest_channel, amount);
  EXPECT_NEAR(found.difference.worst_pixel[0], 30, 1);
  EXPECT_NEAR(found.difference.worst_pixel[1], 50, 1);
  EXPECT_GT(found.difference.max_flip, found.difference.mean_flip);
}

TEST(PictureDifference, IsAmplifiedToWhite) {
  const Image actual = with_changes(3, 5);
  const PictureDifference found = compare_pictures(base(), actual, {}).difference;
  const Image shown = amplified_difference(base(), actual, amplification(found));
  EXPECT_EQ(shown.at(0, 0)[1], 255);
  EXPECT_EQ(shown.at(0, 0)[0], 0);
  EXPECT_EQ(shown.at(1, 0)[1], 0);
  EXPECT_EQ(amplification({}), 1);
}

/// Returns the error of a PNG file; empty if it is valid.
std::string png_refusal(std::string_view png, const Eigen::Vector2i& size = {width, height}) {
  try {
    const Image image = decode_png(png, size);
    EXPECT_EQ(image.width, size.x());
    EXPECT_EQ(image.height, size.y());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(DecodePng, IsTheInverseOfEncoding) { EXPECT_EQ(decode_png(encode_png(base()), {width, height}), base()); }

TEST(DecodePng, RefusesWhatIsCutOff) {
  const std::string png = encode_png(base());
  for (const std::size_t bytes : {0, 7, 8, 23}) EXPECT_EQ(png_refusal(png.substr(0, bytes)), "is not a PNG") << bytes;
  for (const std::size_t bytes : {24, 33, 60, 500}) EXPECT_EQ(png_refusal(png.substr(0, bytes)), "is damaged") << bytes;
  EXPECT_EQ(png_refusal("GIF89a" + png), "is not a PNG");
}

TEST(DecodePng, RefusesAnotherSizeBeforeItUnpacksIt) {
  std::string png = encode_png(base());
  EXPECT_EQ(png_refusal(png, {width, height + 1}), "has 100x80 pixels, expected 100x81");
  png.replace(16, 8, "\x7F\xFF\xFF\xFF\x7F\xFF\xFF\xFF");
  EXPECT_EQ(png_refusal(png), "has 2147483647x2147483647 pixels, expected 100x80");
}

TEST(DecodePng, RefusesDamage) {
  const std::string good = encode_png(base());
  for (std::size_t i = 0; i < good.size(); i += 7) {
    std::string png = good;
    png[i] = static_cast<char>(png[i] ^ 0x10);
    const std::string problem =
        png_refusal(png);  // may be empty: some bytes do not matter, as in the name of a comment
    EXPECT_TRUE(problem.empty() || problem == "is damaged" || problem == "is not a PNG" || problem.starts_with("has "))
        << problem;
  }
}

}  // namespace
}  // namespace drape::picture
