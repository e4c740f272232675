#include "render/texture_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <span>
#include <string>

#include "codecs/codecs.hpp"
#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/read_file.hpp"
#include "core/text.hpp"
#include "render/color.hpp"
#include "render/image_header.hpp"

namespace drape {
namespace {

/// Detects a truncated file by its end. OpenCV's PNG and JPEG readers would fill the missing part with grey and only
/// print a warning.
bool is_cut(std::span<const unsigned char> bytes) {
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

void require_size(const std::filesystem::path& file, int width, int height, int largest) {
  if (std::max(width, height) > largest) {
    throw UsageError(fmt::format("the texture {} has {}x{} pixels; at most {}x{} can be drawn", shown(file), width,
                                 height, largest, largest));
  }
  // Per pixel: the decoded bytes, linear light as floats and as 16 bits, and half of the latter two for smaller levels.
  constexpr double bytes_per_pixel = 3 + 1.5 * (12 + 6);
  require_memory(fmt::format("the texture {} of {}x{} pixels", shown(file), width, height),
                 bytes_per_pixel * width * height, "use a smaller picture");
}

std::string read_bytes(const std::filesystem::path& file) {
  constexpr std::size_t most = std::size_t{1} << 30;
  std::error_code ignored;
  try {
    // The file is read twice: when it is checked and when it is drawn.
    if (std::filesystem::is_fifo(file, ignored)) throw UsageError(shown(file) + ": a pipe cannot be read twice");
    return read_file(file, most);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("the texture {}", error.what()));
  }
}

cv::Mat read_image(const std::filesystem::path& file, int largest) {
  const std::string content = read_bytes(file);
  const std::span bytes(reinterpret_cast<const unsigned char*>(content.data()), content.size());
  if (const auto size = size_in_header(bytes)) require_size(file, size->width, size->height, largest);
  cv::Mat image;
  if (!bytes.empty() && !is_cut(bytes)) {
    try {
      image = decode_picture(content, cv::IMREAD_COLOR);
    } catch (const cv::Exception& error) {
      if (error.code == cv::Error::StsNoMem) throw std::bad_alloc();
      image.release();
    }
  }
  if (image.empty()) {
    throw UsageError(fmt::format(
        "the texture {} is damaged or not an image; expected a PNG, JPEG or another format that OpenCV reads",
        shown(file)));
  }
  require_size(file, image.cols, image.rows, largest);
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

/// Converts sRGB bytes to linear light, 0 to 1.
cv::Mat to_linear(const cv::Mat& encoded) {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<float>(srgb_to_linear(static_cast<double>(i) / 255));
  }
  cv::Mat linear(encoded.size(), CV_32FC3);
  for (int row = 0; row < encoded.rows; ++row) {
    const auto* from = encoded.ptr<std::uint8_t>(row);
    auto* to = linear.ptr<float>(row);
    std::transform(from, from + std::ptrdiff_t{3} * encoded.cols, to,
                   [&table](std::uint8_t value) { return table[value]; });
  }
  return linear;
}

/// Runs work that allocates memory for a texture, and names the texture if memory runs out.
template <class Work>
auto with_memory(const std::filesystem::path& file, Work work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw UsageError(fmt::format("there is not enough memory for the texture {}", shown(file)));
  } catch (const cv::Exception& error) {
    throw UsageError(fmt::format("cannot make a texture of {}: {}", shown(file), error.what()));
  }
}

}  // namespace

std::vector<TextureLevel> load_texture_image(const std::filesystem::path& file, int largest) {
  return with_memory(file, [&] {
    cv::Mat linear = to_linear(read_image(file, largest));
    std::vector<TextureLevel> levels{to_level(linear)};
    while (linear.cols > 1 || linear.rows > 1) {
      cv::Mat half;
      cv::resize(linear, half, {std::max(1, linear.cols / 2), std::max(1, linear.rows / 2)}, 0, 0, cv::INTER_AREA);
      linear = half;
      levels.push_back(to_level(linear));
    }
    return levels;
  });
}

void require_texture_image(const std::filesystem::path& file, int largest) {
  with_memory(file, [&] { read_image(file, largest); });
}

}  // namespace drape
