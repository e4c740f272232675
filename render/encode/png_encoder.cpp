#include "render/encode/png_encoder.hpp"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/error.hpp"

namespace drape {

std::string encode_png(const Image& image) {
  const cv::Mat rgb(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat bgr;
  std::vector<std::uint8_t> bytes;
  try {
    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    if (!cv::imencode(".png", bgr, bytes, {cv::IMWRITE_PNG_COMPRESSION, 6})) throw OutputError("cannot encode a PNG");
  } catch (const cv::Exception& error) {
    throw OutputError(fmt::format("cannot encode a PNG: {}", error.what()));
  }
  return {bytes.begin(), bytes.end()};
}

PngEncoder::PngEncoder(const std::filesystem::path& file) : file_(file) {
  const PartialFile writable(file_);  // or it throws
}

std::vector<OutputFile> PngEncoder::finish(Ending ending) {
  if (!last_) return {};
  PartialFile file(file_);
  file.write(encode_png(*last_));
  const std::uintmax_t size = file.commit(ending);
  return {{file.name(ending), size}};
}

PngSequenceEncoder::PngSequenceEncoder(PathTemplate path, std::string scene, int first_frame, int default_width)
    : path_(std::move(path)), scene_(std::move(scene)), frame_(first_frame), default_width_(default_width) {
  const PartialFile writable(next_path());  // or it throws
}

std::string PngSequenceEncoder::next_path() const { return path_.path(scene_, frame_, default_width_); }

void PngSequenceEncoder::add(const Image& image) {
  const std::string path = next_path();
  files_.push_back({path, write_file_atomically(path, encode_png(image))});
  ++frame_;
}

}  // namespace drape
