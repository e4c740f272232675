#include "cli/frame_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

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
      throw UsageError(fmt::format("--frames takes frame numbers A,B,C, counted from 0; found '{}'", text));
    }
    frames.push_back(frame);
    at = next == end ? end : next + 1;
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

FrameRange parse_frames(const std::string& text) {
  FrameRange range;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, range.first);
  const bool two = first.ec == std::errc() && std::string_view(first.ptr, end).starts_with("..");
  const auto last = two ? std::from_chars(first.ptr + 2, end, range.last) : first;
  if (!two || last.ec != std::errc() || last.ptr != end || range.first < 0 || range.last < range.first) {
    throw UsageError(fmt::format("--frames takes A..B, two frame numbers with 0 ≤ A ≤ B; found '{}'", text));
  }
  return range;
}

}  // namespace drape
