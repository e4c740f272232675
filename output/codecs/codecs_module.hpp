#pragma once

#include <mutex>

#include "output/codecs/codecs.hpp"

namespace drape {

/// Redirects stderr to nowhere during its lifetime: OpenCV 4.6 prints which video tag it substitutes, and no setting
/// prevents it. It affects the whole process, so keep it short: printing code that holds the same mutex waits.
class QuietStderr {
 public:
  explicit QuietStderr(std::mutex& console);
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  std::scoped_lock<std::mutex> lock_;
  int kept_ = -1;  // descriptor of the original stderr
};

/// Silences FFmpeg, which OpenCV uses, on the terminal: exceptions report errors. Holds for the whole process until
/// OpenCV turns the messages on again, at its first use.
void silence_ffmpeg();

/// Implements Codecs::begin_animation for APNG with FFmpeg's libraries: OpenCV cannot write APNG with them.
AnimationPen begin_apng(const std::string& file, double fps, cv::Size size);

}  // namespace drape
