#pragma once

#include <filesystem>
#include <string>

#include "output/format.hpp"

namespace drape {

/// Writes two small frames in a format to a file; writes nothing for a format of steps.
/// @param file name, taken literally
/// @returns codec and library: "H.264, by OpenCV 4.6.0"
/// @throws Error with the reason if the format fails
std::string try_format(const OutputFormat& format, const std::filesystem::path& file);

}  // namespace drape
