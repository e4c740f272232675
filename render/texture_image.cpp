#include "render/texture_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "render/color.hpp"

namespace drape {
namespace {

/// OpenCV's PNG and JPEG readers fill what is missing of a cut file with grey and only print a warning, so the file's
/// end is looked at here.
bool is_cut(const std::vector<unsigned char>& bytes) {
  const auto starts_with = [&bytes](std::initializer_list<unsigned char> signature) {
    return bytes.size() >= signature.size() && std::equal(signature.begin(), signature.end(), bytes.begin());
  };
  const auto contains = [&bytes](std::initializer_list<unsigned char> end) {
    return std::search(bytes.begin(), bytes.end(), end.begin(), end.end()) != bytes.end();
  };
  if (starts_with({0x89, 'P', 'N', 'G'})) return !contains({'I', 'E', 'N', 'D', 0xAE, 0x42, 0x60, 0x82});
  if (starts_with({0xFF, 0xD8, 0xFF})) return !contains({0xFF, 0xD9});
  return false;
}

cv::Mat read_image(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    throw UsageError(fmt::format("cannot read the texture {}", file.string()));
  }
  const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  cv::Mat image;
  if (!bytes.empty() && !is_cut(bytes)) {
    try {
      image = cv::imdecode(bytes, cv::IMREAD_COLOR);
    } catch (const cv::Exception&) {
      image.release();
    }
  }
  if (image.empty()) {
    throw UsageError(fmt::format(
        "the texture {} is damaged or not an image; expected a PNG, JPEG or another format that OpenCV reads",
        file.string()));
  }
  return image;
}

TextureLevel to_level(const cv::Mat& linear) {
  TextureLevel level{linear.cols, linear.rows, {}};
  level.pixels.reserve(3 * linear.total());
  for (int row = linear.rows - 1; row >= 0; --row) {
    for (int column = 0; column < linear.cols; ++column) {
      const auto& bgr = linear.at<cv::Vec3f>(row, column);
      for (int channel = 2; channel >= 0; --channel) {
        level.pixels.push_back(static_cast<std::uint16_t>(std::lround(65535 * std::clamp(bgr[channel], 0.0F, 1.0F))));
      }
    }
  }
  return level;
}

}  // namespace

std::vector<TextureLevel> load_texture_image(const std::filesystem::path& file) {
  const cv::Mat encoded = read_image(file);
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<float>(srgb_to_linear(static_cast<double>(i) / 255));
  }
  cv::Mat linear(encoded.size(), CV_32FC3);
  for (int row = 0; row < encoded.rows; ++row) {
    const auto* from = encoded.ptr<std::uint8_t>(row);
    auto* to = linear.ptr<float>(row);
    std::transform(from, from + 3 * encoded.cols, to, [&table](std::uint8_t value) { return table[value]; });
  }

  std::vector<TextureLevel> levels{to_level(linear)};
  while (linear.cols > 1 || linear.rows > 1) {
    cv::Mat half;
    cv::resize(linear, half, {std::max(1, linear.cols / 2), std::max(1, linear.rows / 2)}, 0, 0, cv::INTER_AREA);
    linear = half;
    levels.push_back(to_level(linear));
  }
  return levels;
}

}  // namespace drape
