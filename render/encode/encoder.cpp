#include "render/encode/encoder.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/nearest.hpp"
#include "render/encode/gif_encoder.hpp"
#include "render/encode/path_template.hpp"
#include "render/encode/png_encoder.hpp"
#include "render/encode/video_encoder.hpp"

namespace drape {
namespace {

/// Of a path, in small letters.
std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

[[noreturn]] void fail_for_extension(const std::string& path, const std::string& extension) {
  const std::vector<std::string> valid{".gif", ".png", ".mp4", ".webm", ".avi"};
  const std::string found = extension.empty() ? "no extension" : fmt::format("the unknown extension '{}'", extension);
  const std::string nearest = nearest_name(extension, valid);
  throw UsageError(fmt::format("the output {} has {}; {}the valid ones are {}", path, found,
                               nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest), quoted_list(valid)));
}

/// Digits of the sequence's last number, so that its files sort by name.
int digits(const OutputSpec& spec) {
  return static_cast<int>(std::to_string(spec.first_frame + std::max(1, spec.expected_frames) - 1).size());
}

}  // namespace

std::vector<std::string> output_files(const OutputSpec& spec) {
  const PathTemplate path(spec.path);
  std::vector<std::string> files;
  for (int i = 0; i < (path.has_frame() ? std::max(1, spec.expected_frames) : 1); ++i) {
    files.push_back(path.path(spec.scene, spec.first_frame + i, digits(spec)));
  }
  return files;
}

std::unique_ptr<Encoder> make_encoder(const OutputSpec& spec) {
  const PathTemplate path_template(spec.path);
  const int width = digits(spec);
  const std::string path = path_template.path(spec.scene, spec.first_frame, width);
  const std::string extension = extension_of(path);
  if (path_template.has_frame() && extension == ".png") {
    return std::make_unique<PngSequenceEncoder>(path_template, spec.scene, spec.first_frame, width);
  }
  const std::vector<VideoCodec> codecs = video_codecs(extension);
  if (extension != ".gif" && extension != ".png" && codecs.empty()) fail_for_extension(spec.path, extension);
  if (path_template.has_frame()) {
    throw UsageError(
        fmt::format("the output {} has a {{frame}}, but a {} holds all frames; only .png makes one file per "
                    "frame",
                    spec.path, extension));
  }
  if (extension == ".png") return std::make_unique<PngEncoder>(path);
  if (extension == ".gif") return std::make_unique<GifEncoder>(path, spec.fps, spec.progress);
  return std::make_unique<VideoEncoder>(path, spec.fps, codecs, spec.width, spec.height);
}

}  // namespace drape
