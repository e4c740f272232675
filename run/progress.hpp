#pragma once

#include <atomic>
#include <string>

namespace drape {

/// How far one stage of a run is. Written by the thread that works, read by the one that shows it.
struct Progress {
  std::atomic<const char*> stage = "";  ///< a verb: "simulating", "drawing"; a literal
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
