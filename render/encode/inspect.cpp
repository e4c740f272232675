#include "render/encode/inspect.hpp"

#include <algorithm>
#include <opencv2/core.hpp>

#include "core/error.hpp"
#include "render/encode/libav.hpp"
#include "render/encode/video_encoder.hpp"

namespace drape {
namespace {

void give_two_frames(Encoder& encoder) {
  Image image(64, 64);
  encoder.add(image);
  std::fill(image.pixels.begin(), image.pixels.end(), std::uint8_t{200});
  encoder.add(image);
  encoder.finish();
}

}  // namespace

std::string encode_two_frames(const std::filesystem::path& file) {
  const std::string by_opencv = "by OpenCV " + cv::getVersionString();
  const std::vector<VideoCodec> codecs = video_codecs(file.extension().string());
  for (const VideoCodec& codec : codecs) {
    try {
      VideoEncoder encoder(file, 25, {codec}, 64, 64);
      give_two_frames(encoder);
      return codec.name + ", " + by_opencv;
    } catch (const OutputError&) {
      if (&codec == &codecs.back()) throw;
    }
  }
  OutputSpec spec;
  spec.path = file.string();
  give_two_frames(*make_encoder(spec));
  return file.extension() == ".gif" ? std::string("by FFmpeg ") + av_version_info() : by_opencv;
}

}  // namespace drape
