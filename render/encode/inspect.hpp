#pragma once

#include <filesystem>
#include <string>

namespace drape {

/// Encodes two small frames into the file, in the form that its extension stands for.
/// @returns what did it: "H.264, by OpenCV 4.6.0"
/// @throws Error why nothing can
std::string encode_two_frames(const std::filesystem::path& file);

}  // namespace drape
