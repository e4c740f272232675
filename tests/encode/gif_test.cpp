#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "drape/core/error.hpp"
#include "tests/support/decoded_film.hpp"
#include "tests/support/encoder.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/files.hpp"
#include "tests/support/gif_file.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_film.hpp"

using namespace drape;
using namespace drape::test;

namespace {

class Gif : public InScratchFolder {
 protected:
  [[nodiscard]] std::unique_ptr<Encoder> encoder(double fps = 25) const {
    return make_encoder(path("x.gif"), {.scene = "test", .fps = fps});
  }

  /// Writes the film to x.gif.
  OutputFile write(const std::vector<Image>& film, double fps = 25) const {
    const auto gif = encoder(fps);
    for (const Image& image : film) gif->add(image);
    return gif->finish().at(0);
  }
};

std::vector<Image> synthetic_film(int frames, int width, int height, Color background = {255, 255, 255}) {
  std::vector<Image> film;
  for (int k = 0; k < frames; ++k) film.push_back(synthetic_frame(k, width, height, background));
  return film;
}

TEST_F(Gif, ShowsEveryFrameFromItsRoundedStartToTheNext) {
  const std::vector<Image> film = synthetic_film(61, 32, 24);
  for (const double fps : {25.0, 30.0, 24.0, 12.5, 29.97, 50.0, 1.0}) {
    write(film, fps);
    const GifFile gif = read_gif(path("x.gif"));
    ASSERT_EQ(gif.delays.size(), film.size()) << fps;
    long total = 0;
    for (std::size_t k = 0; k < film.size(); ++k) {
      total += gif.delays[k];
      EXPECT_EQ(total, std::lround(100 * static_cast<double>(k + 1) / fps)) << "frame " << k << " at " << fps << " fps";
    }
  }
}

TEST_F(Gif, RepeatsForEver) {
  write(synthetic_film(2, 32, 24));
  EXPECT_EQ(read_gif(path("x.gif")).loops, 0);
}

TEST_F(Gif, HasTheSizeOfItsFramesWhichMayBeOdd) {
  write(synthetic_film(2, 31, 17));
  EXPECT_EQ(read_gif(path("x.gif")).width, 31);
  EXPECT_EQ(read_gif(path("x.gif")).height, 17);
}

TEST_F(Gif, MayHaveOneFrame) {
  write(synthetic_film(1, 64, 48), 10);
  EXPECT_EQ(read_gif(path("x.gif")).delays, std::vector<int>{10});
  EXPECT_EQ(decoded_film(path("x.gif")).size(), 1u);
}

TEST_F(Gif, KeepsEveryFrameOfAFilmThatStandsStill) {
  write(std::vector<Image>(9, synthetic_frame(0, 64, 48)));
  EXPECT_EQ(read_gif(path("x.gif")).delays, std::vector<int>(9, 4));
}

TEST_F(Gif, ShowsAnEvenBackgroundExactlyInEveryPixelOfEveryFrame) {
  for (const Color background : {Color{255, 255, 255}, Color{0, 0, 0}, Color{249, 250, 253}, Color{130, 128, 131}}) {
    const std::vector<Image> film = synthetic_film(30, 240, 200, background);
    write(film);
    const std::vector<Image> shown = decoded_film(path("x.gif"));
    ASSERT_EQ(shown.size(), film.size());
    int different = 0;
    for (std::size_t k = 0; k < film.size(); ++k) {
      for (std::size_t i = 0; i < film[k].pixels.size(); i += 3) {
        const auto* source = &film[k].pixels[i];
        if (std::equal(source, source + 3, background.begin()))
          different += !std::equal(source, source + 3, &shown[k].pixels[i]);
      }
    }
    EXPECT_EQ(different, 0);
  }
}

TEST_F(Gif, DoesNotFlickerWhereNothingMoves) {
  // A soft gradient, which is dithered, and a static picture in front, beside a film.
  constexpr int width = 240, height = 200;
  std::vector<Image> film = synthetic_film(20, width, height);
  for (Image& image : film) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < 60; ++x) std::fill_n(image.at(x, y), 3, static_cast<std::uint8_t>(40 + y / 2 + x / 8));
    }
  }
  write(film);
  const std::vector<Image> shown = decoded_film(path("x.gif"));
  ASSERT_EQ(shown.size(), film.size());
  // A slightly wrong pixel may be corrected in the next frame, even if its original happens to stay the same.
  const auto rests = [&film](std::size_t k, int x, int y) {
    for (const auto& [dx, dy] : {std::pair{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      const int column = std::clamp(x + dx, 0, width - 1), row = std::clamp(y + dy, 0, height - 1);
      const std::uint8_t* now = film[k].at(column, row);
      if (!std::equal(now, now + 3, film[k - 1].at(column, row))) return false;
      if (k > 1 && !std::equal(now, now + 3, film[k - 2].at(column, row))) return false;
    }
    return true;
  };
  int changes = 0, resting = 0;
  for (std::size_t k = 1; k < film.size(); ++k) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (!rests(k, x, y)) continue;
        ++resting;
        const std::uint8_t* pixel = shown[k].at(x, y);
        changes += !std::equal(pixel, pixel + 3, shown[k - 1].at(x, y));
      }
    }
  }
  EXPECT_EQ(changes, 0);
  EXPECT_GT(resting, 19 * 60 * height);  // more than the static pixels
}

TEST_F(Gif, PutsAFrameRightWhenItIsShownAgain) {
  // Noise takes so many bytes that pixels get wrong colours, for one frame.
  std::vector<Image> film;
  std::uint32_t random = 1;
  for (int k = 0; k < 12; ++k) {
    Image& image = film.emplace_back(120, 100);
    for (std::uint8_t& value : image.pixels) {
      random = random * 1664525 + 1013904223;
      value = static_cast<std::uint8_t>(50 * ((random >> 16) % 6));  // 216 colours
    }
  }
  film.push_back(film.back());
  write(film);
  const std::vector<Image> shown = decoded_film(path("x.gif"));
  ASSERT_EQ(shown.size(), film.size());
  const auto most_off = [&](std::size_t k) {
    int most = 0;
    for (std::size_t i = 0; i < film[k].pixels.size(); ++i) {
      most = std::max(most, std::abs(film[k].pixels[i] - shown[k].pixels[i]));
    }
    return most;
  };
  EXPECT_GT(most_off(film.size() - 2), 20) << "nothing is to be put right";
  EXPECT_LE(most_off(film.size() - 1), 6);  // 4, weighted by the channel's share of brightness
}

TEST_F(Gif, IsExactForAFilmOfFewColors) {
  std::vector<Image> film;
  for (int k = 0; k < 5; ++k) {
    film.push_back(plain_image(64, 48, {250, 251, 252}));
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 12; ++x) {
        std::uint8_t* pixel = film[k].at(x + 3 * k, y + 2 * k);
        pixel[0] = static_cast<std::uint8_t>(20 * x), pixel[1] = static_cast<std::uint8_t>(20 * y), pixel[2] = 77;
      }
    }
  }
  write(film);
  EXPECT_EQ(decoded_film(path("x.gif")), film);
}

TEST_F(Gif, IsCloseToTheFilm) {
  const std::vector<Image> film = synthetic_film(25, 240, 200);
  write(film);
  const std::vector<Image> shown = decoded_film(path("x.gif"));
  ASSERT_EQ(shown.size(), film.size());
  for (std::size_t k = 0; k < film.size(); ++k) EXPECT_GT(psnr(film[k], shown[k]), 34) << k;
}

TEST_F(Gif, FollowsASoftGradientWithinTwoLevels) {
  // On average over 8×8 pixels, the period of the dither.
  Image gradient(256, 64);
  for (int y = 0; y < 64; ++y) {
    const int band = y / 16;
    for (int x = 0; x < 256; ++x) {
      const double t = (x + 0.5) / 256;
      const double rgb[3] = {40 + 180 * t, 60 + 150 * t * t, 200 - 120 * t};
      for (int c = 0; c < 3; ++c) gradient.at(x, y)[c] = static_cast<std::uint8_t>(rgb[c] + band);
    }
  }
  write({gradient});
  const Image shown = decoded_film(path("x.gif")).at(0);
  double worst = 0;
  for (int y = 0; y + 8 <= 64; y += 8) {
    for (int x = 0; x + 8 <= 256; x += 8) {
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int i = 0; i < 64; ++i) sum += shown.at(x + i % 8, y + i / 8)[c] - gradient.at(x + i % 8, y + i / 8)[c];
        worst = std::max(worst, std::abs(sum / 64.0));
      }
    }
  }
  EXPECT_LT(worst, 2.0);
}

TEST_F(Gif, OfEightSecondsStaysUnderSixMegabytes) {
  const auto gif = encoder();
  for (int k = 0; k < tries(209); ++k) gif->add(synthetic_frame(k, 480, 400));
  const OutputFile file = gif->finish().at(0);
  EXPECT_EQ(file.path, path("x.gif"));
  EXPECT_EQ(file.size, std::filesystem::file_size(path("x.gif")));
  EXPECT_LT(file.size, 6'000'000u);
}

TEST_F(Gif, HasTheSameBytesEveryTime) {
  const std::vector<Image> film = synthetic_film(10, 120, 100);
  write(film);
  const std::string first = test::content(path("x.gif"));
  write(film);
  EXPECT_EQ(test::content(path("x.gif")), first);
}

TEST_F(Gif, ReportsItsProgress) {
  std::vector<int> done;
  const auto gif = make_encoder(path("x.gif"), {.scene = "test", .progress = [&done](int k, int total) {
                                                  EXPECT_EQ(total, 4);
                                                  done.push_back(k);
                                                }});
  for (const Image& image : synthetic_film(4, 32, 24)) gif->add(image);
  EXPECT_TRUE(done.empty());
  gif->finish();
  EXPECT_EQ(done, (std::vector<int>{1, 2, 3, 4}));
}

TEST_F(Gif, LeavesTheOldFileAndNothingElseWithoutFinish) {
  put(path("x.gif"), "old");
  encoder()->add(synthetic_frame(0, 64, 48));
  EXPECT_EQ(test::content(path("x.gif")), "old");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(Gif, LeavesTheOldFileOnAFullDisk) {
  put(path("x.gif"), "old");
  // The first limits affect the stored frames, the last ones the GIF itself.
  for (const rlim_t bytes : {100, 20'000, 200'000}) {
    const FileSizeLimit limit(bytes);
    try {
      write(synthetic_film(20, 240, 200));
      ADD_FAILURE() << "no error with " << bytes << " bytes";
    } catch (const OutputError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find("cannot write " + path("x.gif") + ": "), 0u) << message;
      EXPECT_NE(message.find("File too large"), std::string::npos) << message;
    }
    EXPECT_EQ(test::content(path("x.gif")), "old");
    EXPECT_EQ(file_count(), 1u);
  }
}

TEST_F(Gif, RefusesFramesOfDifferentSizes) {
  const auto gif = encoder();
  gif->add(Image(32, 24));
  EXPECT_THROW(gif->add(Image(24, 32)), std::invalid_argument);
}

}  // namespace
