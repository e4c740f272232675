#include "check/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "core/error.hpp"

namespace drape {

PictureComparison compare_pictures(const Image& expected, const Image& actual, const PictureLimits& limits) {
  if (expected.width != actual.width || expected.height != actual.height) {
    throw std::invalid_argument("compare_pictures() needs two pictures of the same size");
  }
  PictureComparison result;
  if (expected == actual) return result;

  PictureDifference& d = result.difference;
  const std::size_t count = expected.pixels.size() / 3;
  for (std::size_t i = 0; i < count; ++i) {
    int largest = 0;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      largest = std::max(largest, std::abs(expected.pixels[c] - actual.pixels[c]));
    }
    d.pixels += largest > 0 ? 1 : 0;
    d.largest_channel = std::max(d.largest_channel, largest);
  }
  d.fraction = static_cast<double>(d.pixels) / static_cast<double>(count);

  result.flip = flip_error(expected, actual);
  const std::vector<float>& errors = result.flip.values;
  const auto worst = std::max_element(errors.begin(), errors.end());
  const auto place = static_cast<int>(worst - errors.begin());
  d.max_flip = *worst;
  d.mean_flip = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(count);
  d.worst_pixel = {place % expected.width, place / expected.width};

  const bool within = d.largest_channel <= limits.channel && d.fraction <= limits.pixels && d.max_flip <= limits.flip;
  d.verdict = within ? PictureVerdict::noise : PictureVerdict::changed;
  return result;
}

Image amplified_difference(const Image& expected, const Image& actual, double factor) {
  Image image(expected.width, expected.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double value = factor * std::abs(expected.pixels[i] - actual.pixels[i]);
    image.pixels[i] = static_cast<std::uint8_t>(std::lround(std::min(value, 255.0)));
  }
  return image;
}

double amplification(const PictureDifference& difference) {
  return difference.largest_channel == 0 ? 1 : 255.0 / difference.largest_channel;
}

Image read_png(const std::filesystem::path& file) {
  cv::Mat bgr;
  try {
    bgr = cv::imread(file.string(), cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {
    // said below
  }
  if (bgr.empty()) throw UsageError(fmt::format("{}: missing, or no picture", file.string()));
  Image image(bgr.cols, bgr.rows);
  cv::cvtColor(bgr, cv::Mat(bgr.rows, bgr.cols, CV_8UC3, image.pixels.data()), cv::COLOR_BGR2RGB);
  return image;
}

}  // namespace drape
