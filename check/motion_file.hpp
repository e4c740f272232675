#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "check/golden.hpp"

namespace drape {

/// The windows of a golden motion as the bytes of motion.bin: exact states as they are, the steps between them rounded
/// to `quantum` and stored as second differences, all of it as 64-bit words whose most significant bytes come first,
/// then the next ones (so that what is alike stands together), compressed by zlib.
/// @throws std::domain_error if a position is not finite
std::string pack_motion(const std::vector<GoldenWindow>& windows, double quantum);

/// The inverse, but for the rounding of the steps.
/// @throws std::invalid_argument saying what is wrong with the bytes
std::vector<GoldenWindow> unpack_motion(std::string_view bytes, double quantum);

}  // namespace drape
