#include "output/video_check.hpp"

#include <fmt/format.h>

#include <opencv2/videoio.hpp>

#include "core/error.hpp"
#include "output/quiet.hpp"

namespace drape {
namespace {

cv::VideoCapture opened(const std::string& name) {
  const QuietStderr quiet;
  cv::VideoCapture video(name, cv::CAP_FFMPEG);
  silence_ffmpeg();  // OpenCV has just undone it
  return video;
}

}  // namespace

int readable_frames(const PartialFile& file) {
  int found = 0;
  for (cv::VideoCapture video = opened(file.temporary().string()); video.isOpened() && video.grab();) ++found;
  return found;
}

void require_frames(PartialFile& file, int count) {
  const int found = readable_frames(file);
  if (found == count) return;
  file.require_space();
  throw OutputError(
      fmt::format("cannot write {}: of {} frames, {} can be read back", file.file().string(), count, found));
}

}  // namespace drape
