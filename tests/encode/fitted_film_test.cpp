#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "output/scaled_image.hpp"
#include "tests/support/decoded_film.hpp"
#include "tests/support/encoder.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_film.hpp"

using namespace drape;
using namespace drape::test;

namespace {

constexpr int frames = 6, full_width = 240, full_height = 200;

class FittedFilm : public InScratchFolder {
 protected:
  /// @param largest absent: as large as it becomes
  OutputFile write(const std::string& name, std::optional<std::uint64_t> largest, int width = full_width) const {
    FilmInfo film{.scene = "test"};
    film.largest_file = largest;
    const auto encoder = make_encoder(path(name), film);
    const int height = static_cast<int>(std::lround(static_cast<double>(full_height) * width / full_width));
    for (int k = 0; k < frames; ++k) {
      encoder->add(scaled_image(synthetic_frame(k, full_width, full_height), width, height));
    }
    return encoder->finish().at(0);
  }
};

TEST_F(FittedFilm, IsTheFilmItselfWhereThatFits) {
  const std::uint64_t size = write("free.gif", {}).size;
  const OutputFile fitted = write("fitted.gif", size);
  EXPECT_EQ(content(path("fitted.gif")), content(path("free.gif")));
  EXPECT_EQ(fitted.note, "");
  EXPECT_EQ(file_count(), 2U);
}

TEST_F(FittedFilm, IsTheLargestThatFits) {
  for (const std::string extension : {".gif", ".webp", ".apng", ".mp4"}) {
    const std::uint64_t largest = write("free" + extension, {}).size / 3;
    const OutputFile fitted = write("fitted" + extension, largest);
    EXPECT_LE(fitted.size, largest) << extension;
    EXPECT_EQ(fitted.size, std::filesystem::file_size(path("fitted" + extension)));
    const int width = std::stoi(fitted.note);
    EXPECT_LT(width, full_width);
    // What is a hundredth wider, or a pixel, does not fit: that was tried.
    const int wider = width + std::max(1, width / 100);
    bool some_does_not = false;
    for (int w = width + 1; w <= wider; ++w) some_does_not |= write("wider" + extension, {}, w).size > largest;
    EXPECT_TRUE(some_does_not) << extension << " " << width;
  }
}

TEST_F(FittedFilm, HasEveryFrame) {
  const std::uint64_t largest = write("free.gif", {}).size / 4;
  const OutputFile fitted = write("x.gif", largest);
  const std::vector<Image> film = decoded_film(path("x.gif"));
  ASSERT_EQ(film.size(), static_cast<std::size_t>(frames));
  EXPECT_EQ(fitted.note, fmt::format("{}x{} pixels instead of 240x200", film[0].width, film[0].height));
  EXPECT_NEAR(static_cast<double>(film[0].height) / film[0].width, 200.0 / 240, 0.01);
  for (int k = 0; k < frames; ++k) {
    EXPECT_GT(psnr(scaled_image(synthetic_frame(k, 240, 200), film[0].width, film[0].height), film[k]), 24) << k;
  }
}

TEST_F(FittedFilm, TheSameFilmHasTheSameBytes) {
  const std::uint64_t largest = write("free.gif", {}).size / 2;
  write("a.gif", largest);
  write("b.gif", largest);
  EXPECT_EQ(content(path("a.gif")), content(path("b.gif")));
}

TEST_F(FittedFilm, SaysSoWhereNothingFits) {
  put(path("x.gif"), "old");
  try {
    write("x.gif", 500);
    ADD_FAILURE() << "no error";
  } catch (const OutputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find("cannot write " + path("x.gif") + " with at most 500 bytes: at 16x13 pixels it still has "),
              0U)
        << message;
  }
  EXPECT_EQ(content(path("x.gif")), "old");
  EXPECT_EQ(file_count(), 1U);
}

TEST_F(FittedFilm, LeavesOneFileWithThePermissionsOfTheOld) {
  put(path("x.gif"), "old");
  std::filesystem::permissions(path("x.gif"), std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  const std::uint64_t size = write("free.gif", {}).size;
  write("x.gif", size / 2);
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
