#pragma once

#include <filesystem>
#include <string>

#include "output/format.hpp"

namespace drape {

/// Writes two small frames in a format, to a file; nothing where it holds steps.
/// @param file taken as it is, without placeholders
/// @returns what did it: "H.264, by OpenCV 4.6.0"
/// @throws Error why nothing can
std::string try_format(const OutputFormat& format, const std::filesystem::path& file);

}  // namespace drape
