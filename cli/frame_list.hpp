#pragma once

#include <string>
#include <vector>

#include "run/frame_sampler.hpp"

namespace drape {

/// "0,40,80" as numbers, ascending; nothing if it is empty.
/// @throws UsageError if it is anything else
std::vector<int> parse_frame_list(const std::string& text);

/// "A..B" as a range of frames.
/// @throws UsageError if it is anything else
FrameRange parse_frames(const std::string& text);

}  // namespace drape
