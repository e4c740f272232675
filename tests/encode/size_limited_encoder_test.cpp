#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "drape/core/error.hpp"
#include "output/png_encoder.hpp"
#include "tests/support/decoded_film.hpp"
#include "tests/support/encoder.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_film.hpp"

using namespace drape;
using namespace drape::test;

namespace {

constexpr int frames = 12, full_width = 120, full_height = 100;
constexpr double full_rate = 40;

class SizeLimitedEncoder : public InScratchFolder {
 protected:
  /// @param limit  absent: unlimited
  /// @param stride step between used frames; the rate keeps the duration
  OutputFile write(const std::string& name, std::optional<FileLimit> limit, int width = full_width,
                   int stride = 1) const {
    FilmInfo film{.scene = "test", .fps = full_rate / stride};
    film.largest_file = limit;
    const auto encoder = make_encoder(path(name), film);
    const int height = static_cast<int>(std::lround(static_cast<double>(full_height) * width / full_width));
    for (int k = 0; k < frames; k += stride) {
      encoder->add(scaled_image(synthetic_frame(k, full_width, full_height), width, height));
    }
    return encoder->finish().at(0);
  }
  /// Returns the size of the whole film, or of one with smaller or fewer pictures.
  [[nodiscard]] std::uint64_t size_of(const std::string& extension, int width = full_width, int stride = 1) const {
    return write("sized" + extension, {}, width, stride).size;
  }
};

TEST_F(SizeLimitedEncoder, IsTheFilmItselfWhereThatFits) {
  const std::uint64_t size = write("free.gif", {}).size;
  const OutputFile fitted = write("fitted.gif", FileLimit{size});
  EXPECT_EQ(content(path("fitted.gif")), content(path("free.gif")));
  EXPECT_EQ(fitted.note, "");
  EXPECT_EQ(file_count(), 2U);
}

TEST_F(SizeLimitedEncoder, IsTheLargestThatFits) {
  for (const std::string extension : {".gif", ".webp", ".apng", ".mp4"}) {
    const std::uint64_t largest = size_of(extension) / 3;
    const OutputFile fitted = write("fitted" + extension, FileLimit{largest, FilmKeeps::rate});
    EXPECT_LE(fitted.size, largest) << extension;
    EXPECT_EQ(fitted.size, std::filesystem::file_size(path("fitted" + extension)));
    const int width = std::stoi(fitted.note);
    EXPECT_LT(width, full_width);
    // A film that is one percent or one pixel wider does not fit.
    const int wider = width + std::max(1, width / 100);
    bool some_does_not = false;
    for (int w = width + 1; w <= wider; ++w) some_does_not |= size_of(extension, w) > largest;
    EXPECT_TRUE(some_does_not) << extension << " " << width;
  }
}

TEST_F(SizeLimitedEncoder, HasEveryFrameWhereItKeepsItsRate) {
  const OutputFile fitted = write("x.gif", FileLimit{size_of(".gif") / 6, FilmKeeps::rate});
  const std::vector<Image> film = decoded_film(path("x.gif"));
  ASSERT_EQ(film.size(), static_cast<std::size_t>(frames));
  EXPECT_EQ(fitted.note, fmt::format("{}x{} pixels instead of 120x100", film[0].width, film[0].height));
  EXPECT_NEAR(static_cast<double>(film[0].height) / film[0].width, static_cast<double>(full_height) / full_width, 0.01);
  for (int k = 0; k < frames; ++k) {
    EXPECT_GT(psnr(scaled_image(synthetic_frame(k, full_width, full_height), film[0].width, film[0].height), film[k]),
              24)
        << k;
  }
}

TEST_F(SizeLimitedEncoder, HasTheHighestRateThatFitsWhereItKeepsItsSize) {
  for (const double part : {0.7, 0.3}) {
    const auto largest = static_cast<std::uint64_t>(part * static_cast<double>(size_of(".gif")));
    const OutputFile fitted = write("x.gif", FileLimit{largest, FilmKeeps::size});
    int stride = 2;
    while (write("these.gif", {}, full_width, stride).size > largest) ++stride;
    EXPECT_TRUE(content(path("x.gif")) == content(path("these.gif"))) << stride;
    EXPECT_EQ(fitted.note, fmt::format("{:.3g} frames per second instead of 40", full_rate / stride));
  }
}

/// First half the width, then a quarter of the rate at half the width or more, then a smaller width.
TEST_F(SizeLimitedEncoder, GivesUpSizeThenRateThenSize) {
  const std::uint64_t half = size_of(".gif", full_width / 2), slow = size_of(".gif", full_width / 2, 4);
  ASSERT_GT(half, slow);
  EXPECT_EQ(write("x.gif", FileLimit{half}).note.find("frames"), std::string::npos);
  for (const std::uint64_t largest : {half - 1, slow}) {
    const OutputFile fitted = write("x.gif", FileLimit{largest});
    EXPECT_GE(decoded_film(path("x.gif"))[0].width, full_width / 2);
    EXPECT_NE(fitted.note.find("frames per second instead of 40"), std::string::npos) << fitted.note;
  }
  const OutputFile small = write("x.gif", FileLimit{slow - 1});
  const std::vector<Image> film = decoded_film(path("x.gif"));
  EXPECT_LT(film[0].width, full_width / 2);
  EXPECT_EQ(film.size(), 3U);
  EXPECT_NE(small.note.find(" and 10 frames per second instead of 40"), std::string::npos) << small.note;
}

TEST_F(SizeLimitedEncoder, TheSameFilmHasTheSameBytes) {
  const FileLimit limit{size_of(".gif") / 9};
  write("a.gif", limit);
  write("b.gif", limit);
  EXPECT_EQ(content(path("a.gif")), content(path("b.gif")));
}

TEST_F(SizeLimitedEncoder, SaysSoWhereNothingFits) {
  put(path("x.gif"), "old");
  try {
    write("x.gif", FileLimit{500});
    ADD_FAILURE() << "no error";
  } catch (const OutputError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with("cannot write " + path("x.gif") +
                                    " with at most 500 bytes: with 16x13 pixels instead of 120x100 and 10 frames per "
                                    "second instead of 40 it still has "))
        << message;
  }
  EXPECT_EQ(content(path("x.gif")), "old");
  EXPECT_EQ(file_count(), 1U);
}

TEST_F(SizeLimitedEncoder, LeavesOneFileWithThePermissionsOfTheOld) {
  put(path("x.gif"), "old");
  std::filesystem::permissions(path("x.gif"), std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  write("x.gif", FileLimit{size_of(".gif") / 2});
  EXPECT_EQ(file_count(), 2U);
  EXPECT_EQ(std::filesystem::status(path("x.gif")).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST(ScaledImage, MixesLightAndNotBytes) {
  Image checks(40, 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      for (int c = 0; c < 3; ++c) checks.at(x, y)[c] = (x + y) % 2 == 0 ? 255 : 0;
    }
  }
  const Image half = scaled_image(checks, 20, 10);
  for (const std::uint8_t byte : half.pixels) EXPECT_EQ(byte, 188);  // half the light of white, encoded as sRGB
}

TEST(ScaledImage, KeepsWhatIsPlain) {
  for (int byte = 0; byte < 256; ++byte) {
    const auto level = static_cast<std::uint8_t>(byte);
    const Image small = scaled_image(plain_image(37, 23, {level, level, level}), 11, 7);
    for (const std::uint8_t pixel : small.pixels) ASSERT_EQ(pixel, level);
  }
}

}  // namespace
