#include "output/png_encoder.hpp"

#include <fmt/format.h>

#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "codecs/png.hpp"
#include "core/error.hpp"

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

OutputFormat png_format() {
  return {.extension = ".png",
          .help = "picture",
          .made_by = png_library(),
          .packages = "libpng-dev",
          .make = FrameMaker<Image>([](const FilmInfo&) { return encode_png; })};
}

}  // namespace drape
