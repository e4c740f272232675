#include "drape/render/image.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <new>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <span>
#include <stdexcept>
#include <string>

#include "core/files.hpp"
#include "core/machine.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "output/codecs/codecs.hpp"

namespace drape {
namespace {

using Bytes = std::span<const unsigned char>;

/// Reads a whole number of `count` bytes, big-endian.
int number_at(Bytes bytes, std::size_t offset, std::size_t count) {
  int number = 0;
  for (const unsigned char byte : bytes.subspan(offset, count)) number = number << 8 | byte;
  return number;
}

/// Reads an 8-byte signature, then the chunk IHDR (length, name, width, height, …).
std::optional<ImageSize> size_of_png(Bytes bytes) {
  constexpr std::size_t width = 16, height = 20, end = 24;
  if (bytes.size() < end || bytes[width] > 0x7F || bytes[height] > 0x7F) return std::nullopt;
  return ImageSize{number_at(bytes, width, 4), number_at(bytes, height, 4)};
}

/// Reads segments: a marker (FF and a code), a length that excludes the marker, and contents. The start of frame (SOF0
/// to SOF15, except the numbers of DHT, JPG and DAC) holds precision, height, width, …
std::optional<ImageSize> size_of_jpeg(Bytes bytes) {
  constexpr std::array not_frames{0xC4, 0xC8, 0xCC};
  for (std::size_t at = 2; at + 9 <= bytes.size() && bytes[at] == 0xFF;) {
    const int code = bytes[at + 1];
    if (code == 0xFF) {  // padding
      ++at;
    } else if (code >= 0xC0 && code <= 0xCF && std::ranges::find(not_frames, code) == not_frames.end()) {
      return ImageSize{number_at(bytes, at + 7, 2), number_at(bytes, at + 5, 2)};
    } else {
      at += 2 + static_cast<std::size_t>(number_at(bytes, at + 2, 2));
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<ImageSize> size_in_header(Bytes bytes) {
  constexpr std::array<unsigned char, 4> png{0x89, 'P', 'N', 'G'};
  constexpr std::array<unsigned char, 3> jpeg{0xFF, 0xD8, 0xFF};
  if (bytes.size() < png.size()) return std::nullopt;
  if (std::equal(png.begin(), png.end(), bytes.begin())) return size_of_png(bytes);
  if (std::equal(jpeg.begin(), jpeg.end(), bytes.begin())) return size_of_jpeg(bytes);
  return std::nullopt;
}

Image montage(const std::vector<const Image*>& pictures, int columns, int gap, std::uint8_t gray) {
  const int count = static_cast<int>(pictures.size());
  const int across = std::min(columns, count), down = (count + columns - 1) / columns;
  const int width = pictures.front()->width, height = pictures.front()->height;
  Image whole(across * width + (across - 1) * gap, down * height + (down - 1) * gap);
  std::fill(whole.pixels.begin(), whole.pixels.end(), gray);
  for (int i = 0; i < count; ++i) {
    const Image& picture = *pictures[static_cast<std::size_t>(i)];
    if (picture.width != width || picture.height != height) {
      throw std::invalid_argument("pictures of different sizes cannot be put side by side");
    }
    const int left = i % columns * (width + gap), top = i / columns * (height + gap);
    for (int y = 0; y < height; ++y) std::copy_n(picture.at(0, y), 3 * width, whole.at(left, top + y));
  }
  return whole;
}

void append_below(Image& upper, const Image& lower) {
  if (upper.width != lower.width) throw std::invalid_argument("pictures of different widths cannot be put together");
  upper.height += lower.height;
  upper.pixels.insert(upper.pixels.end(), lower.pixels.begin(), lower.pixels.end());
}

namespace {

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
  if (!bytes.empty()) {
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
