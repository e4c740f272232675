#pragma once

#include <string>
#include <vector>

#include "run/frame_sampler.hpp"

namespace drape {

/// Parses "0,40,80" to ascending numbers; nothing for an empty text.
/// @throws UsageError for other texts
std::vector<int> parse_frame_list(const std::string& text);

/// Parses a range of frames "A..B".
/// @throws UsageError for other texts
FrameRange parse_frames(const std::string& text);

}  // namespace drape
