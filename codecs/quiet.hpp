#pragma once

#include <mutex>

namespace drape {

/// While it lives, nothing that libraries print reaches the terminal: OpenCV 4.6 reports to stderr which tag it puts in
/// place of the one asked for, and no setting stops it. For the whole process, so keep it short: who has something to
/// say, and holds the same mutex for it, waits as long.
class QuietStderr {
 public:
  explicit QuietStderr(std::mutex& console);
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  std::scoped_lock<std::mutex> lock_;
  int kept_ = -1;  // what stderr is without it
};

/// Keeps FFmpeg, which OpenCV uses, from writing to the terminal: what goes wrong is reported by exceptions. For the
/// whole process, until OpenCV turns its messages on again, as it does when it is first used.
void silence_ffmpeg();

}  // namespace drape
