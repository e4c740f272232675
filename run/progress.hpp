#pragma once

#include <atomic>
#include <string>

namespace drape {

/// Progress of one stage of a run. Written by the working thread, read by the displaying one.
struct Progress {
  std::atomic<const char*> stage = "";  ///< a verb such as "simulating", "drawing"; a string literal
  std::atomic<const char*> unit = "";   ///< "steps", "frames"
  std::atomic<std::int64_t> done = 0;
  std::atomic<std::int64_t> total = 0;

  void begin(const char* what, const char* of, std::int64_t count) {
    done = 0;
    total = count;
    unit = of;
    stage = what;
  }
};

}  // namespace drape
