#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "check/golden.hpp"

namespace drape {

/// The windows of a golden motion as the bytes of motion.bin: exact states as they are, the steps between them rounded
/// to `quantum` and stored as second differences, all of it as 64-bit words whose most significant bytes come first,
/// then the next ones (so that what is alike stands together), compressed by zlib.
/// @throws std::domain_error if a position is not finite, or so far from the origin that 64 bits cannot count its
/// quanta
std::string pack_motion(const std::vector<GoldenWindow>& windows, double quantum);

/// The inverse, but for the rounding of the steps. Every number that comes out is finite, and every state has as many
/// velocities as positions.
/// @param most_words how many 64-bit words there can be: nothing larger is unpacked
/// @throws std::invalid_argument saying what is wrong with the bytes
std::vector<GoldenWindow> unpack_motion(std::string_view bytes, double quantum, std::uint64_t most_words);

/// How many words windows take at most that have so many vertices and steps in all.
std::uint64_t most_motion_words(std::uint64_t windows, std::uint64_t vertices, std::uint64_t steps);

}  // namespace drape
