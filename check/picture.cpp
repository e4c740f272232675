#include "check/picture.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "output/codecs/codecs.hpp"

namespace drape {
namespace {

/// Returns width and height from the header of a PNG file [pixels], ISO/IEC 15948, 11.2.2.
std::pair<std::uint32_t, std::uint32_t> png_size(std::string_view bytes) {
  constexpr std::string_view signature("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  if (!bytes.starts_with(signature) || bytes.size() < 24) throw std::invalid_argument("is not a PNG");
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
  };
  return {number(16), number(20)};
}

/// Calls visit(column, row) for every pixel covered by a rectangle.
template <class Visit>
void for_each_covered(const std::vector<PixelRectangle>& rectangles, const Eigen::Vector2i& size, const Visit& visit) {
  for (const auto& [left, top, width, height] : rectangles) {
    for (int y = top; y < std::min(top + height, size.y()); ++y) {
      for (int x = left; x < std::min(left + width, size.x()); ++x) visit(x, y);
    }
  }
}

}  // namespace

PictureComparison compare_pictures(const Image& expected, const Image& drawn, const PictureLimits& limits,
                                   const std::vector<PixelRectangle>& ignored) {
  if (expected.width != drawn.width || expected.height != drawn.height) {
    throw std::invalid_argument("compare_pictures() needs two pictures of the same size");
  }
  Image actual = drawn;
  for_each_covered(ignored, {drawn.width, drawn.height},
                   [&](int x, int y) { std::copy_n(expected.at(x, y), 3, actual.at(x, y)); });
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

double covered_part(const std::vector<PixelRectangle>& rectangles, const Eigen::Vector2i& size) {
  std::vector<bool> covered(static_cast<std::size_t>(size.x()) * static_cast<std::size_t>(size.y()));
  for_each_covered(rectangles, size, [&](int x, int y) {
    covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x()) + static_cast<std::size_t>(x)] = true;
  });
  return static_cast<double>(std::count(covered.begin(), covered.end(), true)) / static_cast<double>(covered.size());
}

Image amplified_difference(const Image& expected, const Image& actual, double factor) {
  Image image(expected.width, expected.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double value = factor * std::abs(expected.pixels[i] - actual.pixels[i]);
    image.pixels[i] = static_cast<std::uint8_t>(std::lround(std::min(value, 255.0)));
  }
  return image;
}

std::int64_t summed_difference(const Image& a, const Image& b) {
  return std::transform_reduce(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), std::int64_t{0}, std::plus<>(),
                               [](int x, int y) { return std::abs(x - y); });
}

double amplification(const PictureDifference& difference) {
  return difference.largest_channel == 0 ? 1 : 255.0 / difference.largest_channel;
}

Image decode_png(std::string_view bytes, const Eigen::Vector2i& size) {
  const auto [width, height] = png_size(bytes);
  if (width != static_cast<std::uint32_t>(size.x()) || height != static_cast<std::uint32_t>(size.y())) {
    throw std::invalid_argument(fmt::format("has {}x{} pixels, expected {}x{}", width, height, size.x(), size.y()));
  }
  cv::Mat bgr;
  try {
    bgr = decode_picture(bytes, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    // reported below
  }
  if (bgr.cols != size.x() || bgr.rows != size.y()) throw std::invalid_argument("is damaged");
  Image image(bgr.cols, bgr.rows);
  cv::cvtColor(bgr, cv::Mat(bgr.rows, bgr.cols, CV_8UC3, image.pixels.data()), cv::COLOR_BGR2RGB);
  return image;
}

std::uintmax_t most_png_bytes(const Eigen::Vector2i& size) {
  // Four 16-bit channels and a byte per row, uncompressed, with room for metadata.
  return (std::uintmax_t{1} << 20) + 9 * static_cast<std::uintmax_t>(size.x()) * static_cast<std::uintmax_t>(size.y());
}

}  // namespace drape
