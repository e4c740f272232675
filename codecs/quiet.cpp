#include "codecs/quiet.hpp"

#include <fcntl.h>
#include <unistd.h>

extern "C" {
#include <libavutil/log.h>
}

#include <cstdio>
#include <mutex>
#include <utility>

namespace drape {
namespace {

std::mutex mutex;
int living = 0;  // of all threads
int kept = -1;   // what stderr is without them

}  // namespace

QuietStderr::QuietStderr() {
  const std::scoped_lock lock(mutex);
  if (living++ > 0) return;
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  std::fflush(stderr);
  kept = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (kept >= 0) ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

QuietStderr::~QuietStderr() {
  const std::scoped_lock lock(mutex);
  if (--living > 0 || kept < 0) return;
  std::fflush(stderr);
  ::dup2(kept, STDERR_FILENO);
  ::close(std::exchange(kept, -1));
}

void silence_ffmpeg() { av_log_set_level(AV_LOG_QUIET); }

}  // namespace drape
