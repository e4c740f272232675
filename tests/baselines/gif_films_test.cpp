#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/cli/run_drape.hpp"
#include "tests/support/decoded_film.hpp"

// The films of the showcase as GIFs, each frame compared with its original.

namespace drape::gif_films {
namespace {

namespace fs = std::filesystem;

/// Returns every frame's picture as drawn.
std::vector<Image> originals(const fs::path& folder) {
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.insert(entry.path());
  std::vector<Image> film;
  for (const fs::path& file : files) {
    const cv::Mat bgr = cv::imread(file.string());
    Image image(bgr.cols, bgr.rows);
    cv::Mat rgb(bgr.size(), CV_8UC3, image.pixels.data());
    cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
    film.push_back(std::move(image));
  }
  return film;
}

/// Returns the 256 common colours of a GIF's frames, three bytes each.
std::vector<std::uint8_t> palette(const fs::path& gif) {
  std::ifstream stream(gif, std::ios::binary);
  std::vector<std::uint8_t> bytes(std::size_t{3} * 256);
  stream.seekg(13);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

/// Computes the distance of two colours: the weighted root mean square of their channels, in steps of 1/255.
double distance(const std::uint8_t* a, const std::uint8_t* b) {
  const double red = a[0] - b[0], green = a[1] - b[1], blue = a[2] - b[2];
  return std::sqrt((2 * red * red + 4 * green * green + 3 * blue * blue) / 9);
}

bool same(const std::uint8_t* a, const std::uint8_t* b) { return std::equal(a, a + 3, b); }

class Comparison {
 public:
  Comparison(const fs::path& gif, const fs::path& frames)
      : shown_(test::decoded_film(gif)), film_(originals(frames)), palette_(palette(gif)) {}

  [[nodiscard]] bool has_all_frames() const { return film_.size() > 10 && shown_.size() == film_.size(); }

  /// Counts pixels that keep their colour in both frames although each original has another one.
  [[nodiscard]] int traces() const {
    int count = 0;
    for_each_pixel([&](std::size_t k, int x, int y) {
      const bool stays = same(shown_[k].at(x, y), shown_[k - 1].at(x, y));
      count += stays && is_off(k - 1, x, y) && is_off(k, x, y);
    });
    return count;
  }

  /// Counts pixels that change although neither they nor their neighbours changed in this frame and the previous one,
  /// in which a small error may still be corrected.
  [[nodiscard]] int flickers() const {
    int count = 0;
    for_each_pixel([&](std::size_t k, int x, int y) {
      count += !same(shown_[k].at(x, y), shown_[k - 1].at(x, y)) && rests(k, x, y);
    });
    return count;
  }

 private:
  template <class F>
  void for_each_pixel(F f) const {
    for (std::size_t k = 1; k < film_.size(); ++k) {
      for (int y = 0; y < film_[k].height; ++y) {
        for (int x = 0; x < film_[k].width; ++x) f(k, x, y);
      }
    }
  }

  /// Returns true if a pixel is farther from the original than any colour the dither may choose: the palette colour
  /// nearest to the dithered original.
  [[nodiscard]] bool is_off(std::size_t k, int x, int y) const {
    constexpr double most_of_dither = 2 * 4;  // in both directions
    const std::uint8_t* original = film_[k].at(x, y);
    const double found = distance(original, shown_[k].at(x, y));
    if (found <= most_of_dither) return false;
    double nearest = std::numeric_limits<double>::max();
    for (std::size_t i = 3; i < palette_.size(); i += 3) nearest = std::min(nearest, distance(original, &palette_[i]));
    return found > nearest + most_of_dither;
  }

  [[nodiscard]] bool rests(std::size_t k, int x, int y) const {
    for (const auto& [dx, dy] : {std::pair{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      const int column = std::clamp(x + dx, 0, film_[k].width - 1), row = std::clamp(y + dy, 0, film_[k].height - 1);
      const std::uint8_t* now = film_[k].at(column, row);
      if (!same(now, film_[k - 1].at(column, row))) return false;
      if (k > 1 && !same(now, film_[k - 2].at(column, row))) return false;
    }
    return true;
  }

  std::vector<Image> shown_, film_;
  std::vector<std::uint8_t> palette_;
};

class GifFilm : public ::testing::TestWithParam<std::string> {
 protected:
  /// Draws the film of the test's scene.
  static void expect_neither_traces_nor_flicker(const std::string& options) {
    const test::SceneFolder folder;
    const test::Finished finished =
        test::drape(folder, "render " DRAPE_SOURCE_DIR "/scenes/showcase/" + GetParam() +
                                ".toml --quiet -o film.gif -o 'frames/{frame:04}.png' " + options);
    ASSERT_EQ(finished.code, 0) << finished.text;
    const Comparison comparison(folder.path() / "film.gif", folder.path() / "frames");
    ASSERT_TRUE(comparison.has_all_frames());
    EXPECT_EQ(comparison.traces(), 0);
    EXPECT_EQ(comparison.flickers(), 0);
  }
};

/// Returns the names of the showcase's scenes.
std::vector<std::string> showcase() {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(DRAPE_SOURCE_DIR "/scenes/showcase")) {
    if (entry.path().extension() == ".toml") names.insert(entry.path().stem().string());
  }
  return {names.begin(), names.end()};
}

const auto name_of = [](const auto& scene) { return scene.param; };
INSTANTIATE_TEST_SUITE_P(Showcase, GifFilm, ::testing::ValuesIn(showcase()), name_of);

TEST_P(GifFilm, LeavesNoTracesAndDoesNotFlicker) {
  expect_neither_traces_nor_flicker("--set time.duration=0.8 --set 'video.size=[240, 200]'");
}

using WholeGifFilm = GifFilm;
INSTANTIATE_TEST_SUITE_P(Nightly, WholeGifFilm, ::testing::ValuesIn(showcase()), name_of);

TEST_P(WholeGifFilm, LeavesNoTracesAndDoesNotFlicker) { expect_neither_traces_nor_flicker(""); }

}  // namespace
}  // namespace drape::gif_films
