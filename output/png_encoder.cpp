#include "output/png_encoder.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/render/image.hpp"
#include "output/codecs/codecs.hpp"
#include "render/overlay/diagrams.hpp"

namespace drape {

std::string encode_png(const Image& image) {
  const cv::Mat rgb(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat bgr;
  std::vector<std::uint8_t> bytes;
  try {
    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    bytes = png_from_bgr(bgr);
  } catch (const std::exception& error) {
    throw OutputError(fmt::format("cannot encode a PNG: {}", error.what()));
  }
  return {bytes.begin(), bytes.end()};
}

std::string png_of_texture(const std::filesystem::path& file, int most) {
  try {
    const std::vector<TextureLevel> levels = load_texture_image(file);
    const auto level =
        std::ranges::find_if(levels, [&](const TextureLevel& one) { return std::max(one.width, one.height) <= most; });
    Image image(level->width, level->height);
    for (int y = 0; y < image.height; ++y) {
      for (int i = 0; i < 3 * image.width; ++i) {
        const std::size_t at =
            static_cast<std::size_t>(image.height - 1 - y) * 3 * static_cast<std::size_t>(image.width);
        const double light = level->pixels[at + static_cast<std::size_t>(i)] / 65535.0;
        image.at(0, y)[i] = static_cast<std::uint8_t>(std::lround(255 * linear_to_srgb(light)));
      }
    }
    return encode_png(image);
  } catch (const UsageError& error) {
    throw OutputError(error.what());
  }
}

OutputFormat png_format() {
  return {.extension = ".png",
          .help = "picture",
          .made_by = png_library(),
          .packages = "libpng-dev",
          .make = FrameMaker<Image>([](const FilmInfo&) { return encode_png; })};
}

namespace {

constexpr int gap = 6;  // [pixels]
constexpr std::uint8_t paper = 255;

/// Cuts rows off the bottom of a picture and returns them.
Image cut_below(Image& picture, int rows) {
  Image below(picture.width, rows);
  const auto bytes = static_cast<std::ptrdiff_t>(below.pixels.size());
  std::copy(picture.pixels.end() - bytes, picture.pixels.end(), below.pixels.begin());
  picture.pixels.resize(picture.pixels.size() - below.pixels.size());
  picture.height -= rows;
  return below;
}

/// Appends a narrower picture below another, centred.
void put_below(Image& sheet, const Image& below) {
  const int left = (sheet.width - below.width) / 2, top = sheet.height;
  sheet.pixels.resize(sheet.pixels.size() + std::size_t{3} * sheet.width * below.height, paper);
  sheet.height += below.height;
  for (int y = 0; y < below.height; ++y) std::copy_n(below.at(0, y), 3 * below.width, sheet.at(left, top + y));
}

}  // namespace

bool is_spread(int index, int count, int shown) {
  if (count <= shown) return true;
  if (shown < 2) return index == 0;
  const auto place = [&](std::int64_t k) { return static_cast<int>(k * (count - 1) / (shown - 1)); };
  const int near = static_cast<int>(std::int64_t{index} * (shown - 1) / (count - 1));
  return place(near) == index || (near + 1 < shown && place(near + 1) == index);
}

ContactSheet::ContactSheet(std::filesystem::path file, const FilmInfo& film)
    : file_(std::move(file)),
      grid_(film.sheet.value()),
      first_frame_(film.first_frame),
      expected_frames_(std::max(1, film.expected_frames)),
      seconds_per_frame_(film.seconds_per_frame),
      bands_(film.bands) {
  require_writable(file_);
}

Image ContactSheet::labelled(Image picture, double time) {
  const int size = std::clamp(picture.height / 24, 12, 96), margin = size / 2;
  Image label(picture.width, Pen::line_height(size) + margin);
  std::fill(label.pixels.begin(), label.pixels.end(), paper);
  pen_.write(label, margin, size + margin / 2, "t = " + readable_time(time, seconds_per_frame_), size, band_ink);
  picture.height += label.height;
  picture.pixels.insert(picture.pixels.end(), label.pixels.begin(), label.pixels.end());
  return picture;
}

bool ContactSheet::needs(int index) const { return is_spread(index, expected_frames_, grid_.columns * grid_.rows); }

void ContactSheet::add(const Image& image) {
  const int index = added_++;
  if (!needs(index)) return;
  if (!pictures_.empty() && pictures_.front().width != image.width) {
    throw std::invalid_argument("the frames of a film must have one size");
  }
  Image picture = image;
  legend_ = cut_below(picture, bands_);
  pictures_.push_back(grid_.labelled ? labelled(std::move(picture), (first_frame_ + index) * seconds_per_frame_)
                                     : std::move(picture));
}

std::vector<OutputFile> ContactSheet::finish(Ending ending) {
  if (pictures_.empty()) return {};
  std::vector<const Image*> list;
  for (const Image& picture : pictures_) list.push_back(&picture);
  PartialFile file(file_);
  Image sheet = montage(list, grid_.columns, gap, paper);
  if (legend_.height > 0) put_below(sheet, legend_);
  file.write(encode_png(sheet));
  const std::uintmax_t size = file.commit(ending);
  return {{file.name(ending), size}};
}

PosterFrame::PosterFrame(const std::vector<Triangle>& triangles) {
  std::map<Edge, int> waiting;  // edges of one triangle so far, with its third vertex
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3], opposite = t[(i + 2) % 3];
      const Edge edge{std::min(a, b), std::max(a, b)};
      const auto [other, is_new] = waiting.emplace(edge, opposite);
      if (!is_new) hinges_.push_back({edge, {other->second, opposite}});
    }
  }
}

double PosterFrame::bend(const Vertices& x) const {
  double sum = 0;
  for (const Hinge& hinge : hinges_) {
    const Eigen::Vector3d from = x.row(hinge.edge[0]), edge = x.row(hinge.edge[1]).transpose() - from;
    const Eigen::Vector3d n = edge.cross(x.row(hinge.opposite[0]).transpose() - from),
                          m = (x.row(hinge.opposite[1]).transpose() - from).cross(edge);
    sum += edge.norm() * std::atan2(n.cross(m).norm(), n.dot(m));
  }
  return sum;
}

bool PosterFrame::see(const Vertices& positions) {
  constexpr double noise = 1e-9;  // rounding of coordinates bends even a flat cloth
  const double now = bend(positions);
  const int frame = seen_++;
  if (frame > 0 && now <= most_ + noise) return false;
  most_ = now;
  index_ = frame;
  return true;
}

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
