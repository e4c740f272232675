#include "cli/frame_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/error.hpp"

namespace drape {

std::vector<int> parse_frame_list(const std::string& text) {
  std::vector<int> frames;
  const char *at = text.data(), *const end = at + text.size();
  while (at != end) {
    int frame = -1;
    const auto [next, error] = std::from_chars(at, end, frame);
    const bool separated = next == end || (*next == ',' && next + 1 != end);
    if (error != std::errc() || frame < 0 || !separated) {
      throw UsageError(fmt::format("--frames takes A,B,C, numbers of frames from 0 on, found '{}'", text));
    }
    frames.push_back(frame);
    at = next == end ? end : next + 1;
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

}  // namespace drape
