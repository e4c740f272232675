#include <mutex>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "codecs/codecs.hpp"
#include "codecs/libav_animation.hpp"
#include "codecs/quiet.hpp"
#include "codecs/webp_animation.hpp"

// The module: drape links none of it, and finds it by the single name at the end.

namespace drape {
namespace {

std::mutex* console = nullptr;  // the program's mutex, see QuietStderr

cv::Mat decode(std::string_view bytes, int flags) {
  const cv::Mat all(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
  const QuietStderr quiet(*console);  // libpng would print errors without the file's name
  return cv::imdecode(all, flags);
}

VideoPen begin_video(const std::string& file, const std::string& fourcc, double fps, cv::Size size) {
  const QuietStderr quiet(*console);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::VideoWriter writer;
  const int code = cv::VideoWriter::fourcc(fourcc[0], fourcc[1], fourcc[2], fourcc[3]);
  const bool opened = writer.open(file, cv::CAP_FFMPEG, code, fps, size);
  silence_ffmpeg();  // OpenCV turns its messages on at first use
  if (!opened) return {};
  return [writer](const cv::Mat& bgr) mutable { writer.write(bgr); };
}

AnimationPen begin_animation(const std::string& file, const std::string& form, double fps, cv::Size size) {
  return form == "webp" ? begin_webp(file, fps, size) : begin_apng(file, fps, size);
}

cv::VideoCapture opened(const std::string& file) {
  const QuietStderr quiet(*console);
  cv::VideoCapture video(file, cv::CAP_FFMPEG);
  silence_ffmpeg();  // OpenCV has just turned them on
  return video;
}

int readable_frames(const std::string& file) {
  int found = 0;
  for (cv::VideoCapture video = opened(file); video.isOpened() && video.grab();) ++found;
  return found;
}

}  // namespace
}  // namespace drape

extern "C" const drape::Codecs* drape_codecs(std::mutex& console) {
  drape::console = &console;
  static constexpr drape::Codecs codecs{drape::decode, drape::begin_video, drape::begin_animation,
                                        drape::readable_frames};
  return &codecs;
}
