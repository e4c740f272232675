#include "output/png_encoder.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "output/registry.hpp"
#include "tests/support/scratch_folder.hpp"

namespace drape::contact_sheet {
namespace {

TEST(ContactSheet, ChoosesMomentsEvenlyWithBothEnds) {
  for (const int count : {1, 2, 5, 12, 13, 100, 209}) {
    for (const int shown : {1, 2, 6, 12}) {
      std::vector<int> chosen;
      for (int i = 0; i < count; ++i) {
        if (is_spread(i, count, shown)) chosen.push_back(i);
      }
      ASSERT_EQ(chosen.size(), static_cast<std::size_t>(std::min(count, shown))) << count << " " << shown;
      EXPECT_EQ(chosen.front(), 0);
      if (shown > 1) {
        EXPECT_EQ(chosen.back(), count - 1);
      }
      for (std::size_t i = 2; i < chosen.size(); ++i) {
        EXPECT_LE(std::abs((chosen[i] - chosen[i - 1]) - (chosen[1] - chosen[0])), 1) << count << " " << shown;
      }
    }
  }
}

TEST(ContactSheet, HasThePicturesInOrder) {
  const test::ScratchFolder folder;
  FilmInfo film;
  film.expected_frames = 10;
  film.sheet = SheetGrid{.columns = 2, .rows = 2};
  const std::string file = (folder.path() / "sheet.png").string();
  AnySink any = make_sink(file, film);
  auto& sheet = *std::get<std::unique_ptr<Encoder>>(any);
  for (int i = 0; i < 10; ++i) {
    Image image(80, 60);
    std::fill(image.pixels.begin(), image.pixels.end(), static_cast<std::uint8_t>(10 * i));
    sheet.add(image);
  }
  sheet.finish();
  const cv::Mat whole = cv::imread(file);
  EXPECT_EQ(whole.cols, 2 * 80 + 6);
  const int second_row = whole.rows / 2 + 20;
  EXPECT_EQ(whole.at<cv::Vec3b>(30, 40)[0], 0);
  EXPECT_EQ(whole.at<cv::Vec3b>(30, 126)[0], 30);
  EXPECT_EQ(whole.at<cv::Vec3b>(second_row, 40)[0], 60);
  EXPECT_EQ(whole.at<cv::Vec3b>(second_row, 126)[0], 90);
}

TEST(ContactSheet, HasTheLegendOnce) {
  const test::ScratchFolder folder;
  const auto rows = [&](int bands) {
    FilmInfo film;
    film.expected_frames = 4;
    film.sheet = SheetGrid{.columns = 2, .rows = 2};
    film.bands = bands;
    const std::string file = (folder.path() / "sheet.png").string();
    AnySink any = make_sink(file, film);
    auto& sheet = *std::get<std::unique_ptr<Encoder>>(any);
    for (int i = 0; i < 4; ++i) {
      Image image(80, 60 + bands);
      std::fill(image.pixels.begin() + std::ptrdiff_t{3} * 80 * 60, image.pixels.end(),
                static_cast<std::uint8_t>(40 + i));
      sheet.add(image);
    }
    sheet.finish();
    const cv::Mat whole = cv::imread(file);
    if (bands > 0) {
      EXPECT_EQ(whole.at<cv::Vec3b>(whole.rows - 5, whole.cols / 2)[0], 43) << "it is that of the last picture";
    }
    return whole.rows;
  };
  EXPECT_EQ(rows(20), rows(0) + 20);
}

TEST(ContactSheet, TellsMomentsApartThatAreMillisecondsApart) {
  const test::ScratchFolder folder;
  FilmInfo film;
  film.seconds_per_frame = 0.002;
  film.first_frame = 140;
  film.expected_frames = 2;
  film.sheet = SheetGrid{.columns = 2, .rows = 1};
  const std::string file = (folder.path() / "sheet.png").string();
  AnySink any = make_sink(file, film);
  auto& sheet = *std::get<std::unique_ptr<Encoder>>(any);
  for (int i = 0; i < 2; ++i) sheet.add(Image(160, 20));
  sheet.finish();
  const cv::Mat whole = cv::imread(file);
  const cv::Rect label(0, 20, 160, whole.rows - 20);
  EXPECT_GT(cv::norm(whole(label), whole(label + cv::Point(whole.cols - 160, 0)), cv::NORM_INF), 0);
}

TEST(ContactSheet, OneFilePerFrameStaysThat) {
  const test::ScratchFolder folder;
  FilmInfo film;
  film.expected_frames = 2;
  film.sheet = SheetGrid{.columns = 2, .rows = 1};
  AnySink any = make_sink((folder.path() / "{frame}.png").string(), film);
  auto& frames = *std::get<std::unique_ptr<Encoder>>(any);
  frames.add(Image(16, 16));
  frames.add(Image(16, 16));
  EXPECT_EQ(frames.finish().size(), 2U);
}

}  // namespace
}  // namespace drape::contact_sheet
