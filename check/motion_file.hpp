#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "check/golden.hpp"

namespace drape {

/// Serialises the windows of a golden motion and the positions of its pictures as motion.bin, without loss. A row of a
/// vector field is stored in multiples of the field's quantum, or as raw bits if it is not a multiple. Both are stored
/// as differences from a prediction by neighbouring vertices. Body positions are stored as second differences, those
/// that are not 0. All become 64-bit words, arranged by byte significance (so that similar bytes are adjacent), and
/// compressed by zlib.
std::string pack_motion(const Golden& golden);

/// Reads motion.bin: fills in the windows of a golden and the positions of its frames; all else must be known. Every
/// number read is finite. The size is limited to that of such a golden.
/// @throws std::invalid_argument that describes the error in the bytes
void unpack_motion(std::string_view bytes, Golden& golden);

/// Returns the largest size of a golden's motion [bytes].
std::uint64_t most_motion_bytes(const Golden& golden);

}  // namespace drape
