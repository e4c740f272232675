#include "output/scaled_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "render/color.hpp"

namespace drape {
namespace {

constexpr int levels = 1 << 14;  // of linear light, fine enough for the darkest bytes

const std::array<float, 256>& light_of_bytes() {
  static const auto table = [] {
    std::array<float, 256> light{};
    for (std::size_t i = 0; i < light.size(); ++i)
      light[i] = static_cast<float>(srgb_to_linear(static_cast<double>(i) / 255));
    return light;
  }();
  return table;
}

const std::array<std::uint8_t, levels + 1>& bytes_of_light() {
  static const auto table = [] {
    std::array<std::uint8_t, levels + 1> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      bytes[i] = static_cast<std::uint8_t>(std::lround(255 * linear_to_srgb(static_cast<double>(i) / levels)));
    }
    return bytes;
  }();
  return table;
}

}  // namespace

Image scaled_image(const Image& image, int width, int height) {
  if (width == image.width && height == image.height) return image;
  cv::Mat light(image.height, image.width, CV_32FC3), small;
  std::transform(image.pixels.begin(), image.pixels.end(), light.ptr<float>(),
                 [&](std::uint8_t byte) { return light_of_bytes()[byte]; });
  cv::resize(light, small, {width, height}, 0, 0, cv::INTER_AREA);
  Image result(width, height);
  const float* const from = small.ptr<float>();
  std::transform(from, from + result.pixels.size(), result.pixels.begin(), [](float l) {
    return bytes_of_light()[static_cast<std::size_t>(
        std::clamp(std::lround(l * levels), 0L, static_cast<long>(levels)))];
  });
  return result;
}

}  // namespace drape
