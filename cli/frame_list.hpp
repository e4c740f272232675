#pragma once

#include <string>
#include <vector>

namespace drape {

/// "0,40,80" as numbers, ascending; nothing if it is empty.
/// @throws UsageError if it is anything else
std::vector<int> parse_frame_list(const std::string& text);

}  // namespace drape
