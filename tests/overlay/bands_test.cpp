#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "render/overlay/color_scale.hpp"
#include "render/overlay/diagrams.hpp"

namespace drape::overlay_bands {
namespace {

TEST(Viridis, IsThePublishedMap) {
  cv::Mat grays(1, 256, CV_8UC1), colors;  // OpenCV has the whole table
  for (int i = 0; i < 256; ++i) grays.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  cv::applyColorMap(grays, colors, cv::COLORMAP_VIRIDIS);
  for (int i = 0; i < 256; ++i) {
    const auto bgr = colors.at<cv::Vec3b>(0, i);
    const Rgb color = viridis(i / 255.0);
    EXPECT_NEAR(255 * color.r, bgr[2], 1.01) << i;
    EXPECT_NEAR(255 * color.g, bgr[1], 1.01) << i;
    EXPECT_NEAR(255 * color.b, bgr[0], 1.01) << i;
  }
  EXPECT_EQ(viridis(-1), viridis(0));
  EXPECT_EQ(viridis(2), viridis(1));
}

TEST(Ticks, AreMultiplesOfOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(round_up(0.3), 0.5);
  EXPECT_DOUBLE_EQ(round_up(2), 2);
  EXPECT_DOUBLE_EQ(round_up(51), 100);
  std::vector<std::string> labels;
  for (const Tick& tick : ticks(-4.3, 2, 3)) labels.push_back(tick.label);
  EXPECT_EQ(labels, (std::vector<std::string>{"-4", "-2", "0", "2"}));
}

TEST(Ticks, AreThinnedUntilTheirLabelsStandApart) {
  std::vector<Tick> marks;
  for (int i = 0; i <= 10; ++i) marks.push_back({i / 10.0, std::to_string(i)});
  const auto kept = [&](int width) {
    const auto columns = [width](const Tick& mark) {
      const int middle = static_cast<int>(std::lround(200 * mark.value));
      return std::pair{middle - width / 2, middle + width / 2};
    };
    std::string labels;
    for (const Tick& mark : thinned(marks, columns, 4)) labels += mark.label + " ";
    return labels;
  };
  EXPECT_EQ(kept(16), "0 1 2 3 4 5 6 7 8 9 10 ");
  EXPECT_EQ(kept(18), "0 2 4 6 8 10 ");
  EXPECT_EQ(kept(40), "0 5 10 ");
  EXPECT_EQ(kept(120), "0 10 ");
  EXPECT_EQ(kept(1000), "0 ");
}

TEST(Ticks, KeepZeroWhenTheyAreThinned) {
  std::string labels;
  const auto rows = [](const Tick& mark) {
    const int row = static_cast<int>(std::lround(10 * mark.value));
    return std::pair{row, row + 15};
  };
  for (const Tick& mark : thinned(ticks(-3, 4, 7), rows, 0)) labels += mark.label + " ";
  EXPECT_EQ(labels, "-2 0 2 4 ");
}

/// Returns the heights of the labels of values of a diagram without a legend [pixels].
std::vector<int> label_heights(const Image& band, int size) {
  std::vector<int> heights;
  bool inside = false;
  for (int y = 0; y < band.height - 2 * size + size / 2; ++y) {
    bool letter = false;
    for (int x = 0; x < size / 2 + size; ++x) letter = letter || *band.at(x, y) < 160;
    if (letter && !inside) heights.push_back(0);
    if (letter) ++heights.back();
    inside = letter;
  }
  return heights;
}

TEST(CurveBand, LabelsOfValuesStandApart) {
  Pen pen;
  const int size = 14;
  for (const double lowest : {0.0, -2.0, -4.0, -6.0, -8.0}) {
    for (const double highest : {2.0, 4.0, 6.0, 7.0}) {
      const CurveBand band(400, size, "J", {0, 1}, {{"", {1, 1, 1}, {lowest, highest}}});
      const std::vector<int> heights = label_heights(band.draw(pen, 1), size);
      EXPECT_GE(heights.size(), 2U) << lowest << " to " << highest;
      for (const int height : heights) EXPECT_LE(height, size) << lowest << " to " << highest;
    }
  }
}

/// Returns the widths of blank columns between the first and the last letter of the labels at the foot of a band.
std::vector<int> gaps_at_foot(const Image& band, int rows) {
  std::vector<int> gaps;
  int last = -1;
  for (int x = 0; x < band.width; ++x) {
    bool letter = false;
    for (int y = band.height - rows; y < band.height; ++y) letter = letter || *band.at(x, y) < 160;
    if (!letter) continue;
    if (last >= 0) gaps.push_back(x - last - 1);
    last = x;
  }
  return gaps;
}

TEST(CurveBand, LabelsOfTimesStandApartOnANarrowFilm) {
  Pen pen;
  for (const int width : {120, 200, 320, 640}) {
    const int size = 11;
    const CurveBand band(width, size, "J", {0, 0.6, 1.2}, {{"total", {0, 0, 0}, {0.1, 0.2, 0.15}}});
    const std::vector<int> gaps = gaps_at_foot(band.draw(pen, 1.2), size + size / 2);
    // Letters of a label are less than four columns apart, labels at least half a letter.
    for (const int gap : gaps) EXPECT_TRUE(gap < 5 || gap >= size / 2) << width << ": " << gap;
    EXPECT_GE(std::ranges::count_if(gaps, [&](int gap) { return gap >= size / 2; }), 1) << width;
  }
}

/// Returns the last column with a letter in the first rows of a band.
int last_letter(const Image& band, int rows) {
  int last = -1;
  for (int y = 0; y < rows; ++y) {
    for (int x = last + 1; x < band.width; ++x) last = *band.at(x, y) < 160 ? x : last;
  }
  return last;
}

/// Returns the last column with a letter in the last rows of a band.
int last_letter_at_foot(const Image& band, int rows) {
  int last = -1;
  for (int y = band.height - rows; y < band.height; ++y) {
    for (int x = last + 1; x < band.width; ++x) last = *band.at(x, y) < 160 ? x : last;
  }
  return last;
}

TEST(CurveBand, HasItsLegendInsideTheFilm) {
  Pen pen;
  const std::vector<double> values{0, 1};
  for (const int width : {280, 320, 360, 480}) {
    std::vector<Curve> curves;
    for (const char* name : {"total", "kinetic", "gravity", "elastic"}) curves.push_back({name, {0, 0, 0}, values});
    const Image band = CurveBand(width, 20, "J", {0, 1}, curves).draw(pen, 0);
    const int last = last_letter(band, 30);
    EXPECT_LT(last, width - 1);
    EXPECT_GT(last, 0.85 * width) << "no smaller than needed";
  }
  for (const int width : {110, 130, 150}) {
    std::vector<Curve> curves;
    for (const char* name : {"total", "kinetic", "gravity", "elastic"}) curves.push_back({name, {0, 0, 0}, values});
    EXPECT_LT(last_letter(CurveBand(width, 11, "J", {0, 1}, curves).draw(pen, 0), 24), width - 1) << "in two rows";
  }
}

TEST(ColorBar, HasItsTitleInsideThePicture) {
  Pen pen;
  const std::string title = "distance from the first, a scene with quite a long name [mm]";
  for (const int width : {260, 300, 340, 420}) {
    EXPECT_LT(last_letter(color_bar(pen, width, 14, title, {}), 14 + 14 / 2), width - 1) << width;
  }
}

TEST(ColorBar, SaysIfItsTitleHasNoRoom) {
  Pen pen;
  const std::string title = "distance from the first, a scene with quite a long name [mm]";
  EXPECT_TRUE(has_room_for_title(pen, 260, 14, title));
  EXPECT_FALSE(has_room_for_title(pen, 160, 14, title));
}

TEST(ColorBar, LabelsItsLastColourWhereOthersHaveNoRoom) {
  Pen pen;
  const int size = 11;
  for (const int width : {90, 120, 160, 200, 300}) {
    const Image bar = color_bar(pen, width, size, "speed [m/s]", ColorScale(5).marks(1));
    const int end = width - std::min(2 * size, width / 6);  // of the colours
    const std::vector<int> gaps = gaps_at_foot(bar, size + size / 2);
    EXPECT_GE(std::ranges::count_if(gaps, [&](int gap) { return gap >= size / 2; }), 1) << width;
    EXPECT_GE(last_letter_at_foot(bar, size + size / 2), end) << width;
  }
}

TEST(ColorScale, MarksItsLimit) {
  const auto labels = [](double limit, double factor) {
    std::string all;
    for (const Tick& mark : ColorScale(limit).marks(factor)) all += mark.label + ' ';
    return all;
  };
  EXPECT_EQ(labels(2, 1), "0 0.2 0.4 0.6 0.8 1 1.2 1.4 1.6 1.8 ≥ 2 ");
  EXPECT_EQ(labels(0.7, 1), "0 0.1 0.2 0.3 0.4 0.5 0.6 ≥ 0.7 ");
  EXPECT_EQ(labels(0.73, 1), "0 0.1 0.2 0.3 0.4 0.5 0.6 ≥ 0.73 ");
  EXPECT_EQ(labels(0.78, 1), "0 0.1 0.2 0.3 0.4 0.5 0.6 0.7 ≥ 0.78 ");
  EXPECT_EQ(labels(0.07, 100), "0 1 2 3 4 5 6 ≥ 7 ");
}

TEST(ColorBar, HasTheColourThatAMarkStandsFor) {
  Pen pen;
  const int size = 14;
  const Image bar = color_bar(pen, 400, size, "speed [m/s]", {{0, "0"}, {0.5, "1"}, {1, "2"}});
  EXPECT_EQ(bar.height, color_bar_height(size));
  const auto has = [&](const Rgb& color) {
    for (int y = 0; y < bar.height; ++y) {
      for (int x = 0; x < bar.width; ++x) {
        const std::uint8_t* p = bar.at(x, y);
        if (std::abs(p[0] - 255 * color.r) < 2 && std::abs(p[1] - 255 * color.g) < 2 &&
            std::abs(p[2] - 255 * color.b) < 2)
          return true;
      }
    }
    return false;
  };
  EXPECT_TRUE(has(viridis(0)));
  EXPECT_TRUE(has(viridis(0.5)));
  EXPECT_TRUE(has(viridis(1)));
}

/// Returns the first and the last column with a pixel of nearly this colour.
std::pair<int, int> columns_of(const Image& image, const Rgb& color) {
  std::pair<int, int> columns{image.width, -1};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.at(x, y);
      if (std::abs(p[0] - 255 * color.r) > 3 || std::abs(p[1] - 255 * color.g) > 3 ||
          std::abs(p[2] - 255 * color.b) > 3)
        continue;
      columns = {std::min(columns.first, x), std::max(columns.second, x)};
    }
  }
  return columns;
}

TEST(CurveBand, EndsWhereTheFilmIsAndKeepsItsAxes) {
  Pen pen;
  const Rgb blue{0, 0, 1};
  std::vector<double> times, values;
  for (int i = 0; i <= 100; ++i) {
    times.push_back(0.02 * i);
    values.push_back(std::sin(0.1 * i));
  }
  const CurveBand band(600, 14, "J", times, {{"a name of some length that has no place of its own", blue, values}});
  const Image half = band.draw(pen, 1), whole = band.draw(pen, 2);
  EXPECT_EQ(half.height, CurveBand::height(14));
  const auto [from, to] = columns_of(half, blue);
  const auto [whole_from, whole_to] = columns_of(whole, blue);
  EXPECT_EQ(from, whole_from);
  EXPECT_NEAR(to, (whole_from + whole_to) / 2.0, 8);
  // Drawn curves do not change: up to the half film's time both are equal, except the dot at its end.
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < to - 10; ++x) ASSERT_TRUE(std::equal(half.at(x, y), half.at(x, y) + 3, whole.at(x, y)));
  }
}

TEST(CurveBand, TakesAFilmOfOneFrameAndEnergiesOfZero) {
  Pen pen;
  const CurveBand band(200, 12, "J", {0}, {{"total", {0, 0, 0}, {0}}});
  EXPECT_EQ(band.draw(pen, 0).width, 200);
}

}  // namespace
}  // namespace drape::overlay_bands
