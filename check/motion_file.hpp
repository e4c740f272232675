#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "check/golden.hpp"

namespace drape {

/// The windows of a golden motion and the positions in its pictures as the bytes of motion.bin: nothing is lost. Of a
/// row of a field of vectors that is a multiple of the field's quantum, the multiples are stored, and of any other row
/// the bits; of both the difference from what the vertices beside it foretell. What moves the cloth is stored as second
/// differences, and only those that are not 0. All of it becomes 64-bit words whose most significant bytes come first,
/// then the next ones (so that what is alike stands together), compressed by zlib.
std::string pack_motion(const Golden& golden);

/// The inverse: fills in the windows of a golden, and the positions of its frames, of which everything else is known.
/// Every number that comes out is finite. Nothing larger is unpacked than belongs to such a golden.
/// @throws std::invalid_argument saying what is wrong with the bytes
void unpack_motion(std::string_view bytes, Golden& golden);

/// How many bytes the motion of a golden takes at most.
std::uint64_t most_motion_bytes(const Golden& golden);

}  // namespace drape
