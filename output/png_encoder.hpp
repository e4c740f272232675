#pragma once

#include <string>

#include "output/format.hpp"

namespace drape {

/// Encodes an image as a PNG file. The same image gives the same bytes.
/// @throws OutputError
std::string encode_png(const Image& image);

OutputFormat png_format();

}  // namespace drape
