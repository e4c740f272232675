#include "study/drawn_text.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace drape {
namespace {

constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
constexpr double capital = 21;    // height of a capital letter at scale 1 [pixels]
constexpr int supersampling = 4;  // drawn larger and averaged: strokes are smooth at any size

/// The letters that the font has: µ is a u to which a stem is added.
std::string plain(const std::string& text, std::vector<std::size_t>& stems) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "µ") == 0) {
      stems.push_back(result.size());
      result += 'u';
      ++i;
    } else {
      result += text[i];
    }
  }
  return result;
}

int width_of(const std::string& letters, double scale, int thickness) {
  int base = 0;
  return cv::getTextSize(letters, font, scale, thickness, &base).width;
}

struct Stroke {
  double scale;
  int thickness;
  explicit Stroke(double height)
      : scale(supersampling * height / capital),
        thickness(std::max(1, static_cast<int>(std::lround(supersampling * height / 8.5)))) {}
};

}  // namespace

int text_width(const std::string& text, double height) {
  std::vector<std::size_t> stems;
  const Stroke stroke(height);
  return width_of(plain(text, stems), stroke.scale, stroke.thickness) / supersampling;
}

void draw_text(Image& image, int left, int base, const std::string& text, double height, const Rgb& color) {
  std::vector<std::size_t> stems;
  const std::string letters = plain(text, stems);
  const Stroke stroke(height);
  const int below = static_cast<int>(std::ceil(0.5 * height)), above = static_cast<int>(std::ceil(1.3 * height));
  const int width = text_width(text, height) + below;
  cv::Mat large = cv::Mat::zeros(supersampling * (above + below), supersampling * width, CV_8UC1);
  const cv::Point origin(0, supersampling * above);
  cv::putText(large, letters, origin, font, stroke.scale, 255, stroke.thickness, cv::LINE_AA);
  for (const std::size_t stem : stems) {
    const int x = width_of(letters.substr(0, stem), stroke.scale, 1) + static_cast<int>(4 * stroke.scale);
    cv::line(large, {x, origin.y - static_cast<int>(6 * stroke.scale)},
             {x, origin.y + static_cast<int>(7 * stroke.scale)}, 255, stroke.thickness, cv::LINE_AA);
  }
  cv::Mat coverage;
  cv::resize(large, coverage, {width, above + below}, 0, 0, cv::INTER_AREA);
  const double ink[3] = {255 * color.r, 255 * color.g, 255 * color.b};
  for (int y = 0; y < coverage.rows; ++y) {
    for (int x = 0; x < coverage.cols; ++x) {
      const int column = left + x, row = base - above + y;
      if (column < 0 || row < 0 || column >= image.width || row >= image.height) continue;
      const double part = coverage.at<std::uint8_t>(y, x) / 255.0;
      std::uint8_t* pixel = image.at(column, row);
      for (int c = 0; c < 3; ++c) {
        pixel[c] = static_cast<std::uint8_t>(std::lround(std::lerp(static_cast<double>(pixel[c]), ink[c], part)));
      }
    }
  }
}

Rgb viridis(double value) {
  static const cv::Mat table = [] {
    cv::Mat grays(1, 256, CV_8UC1), colors;
    for (int i = 0; i < 256; ++i) grays.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
    cv::applyColorMap(grays, colors, cv::COLORMAP_VIRIDIS);
    return colors;
  }();
  const auto bgr = table.at<cv::Vec3b>(0, static_cast<int>(std::lround(255 * std::clamp(value, 0.0, 1.0))));
  return {bgr[2] / 255.0, bgr[1] / 255.0, bgr[0] / 255.0};
}

}  // namespace drape
