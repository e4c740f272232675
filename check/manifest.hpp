#pragma once

#include <string>
#include <string_view>

#include "check/golden.hpp"

namespace drape {

/// manifest.json, read.
struct Manifest {
  Golden golden;            ///< all but its windows, and the positions in its frames
  std::string motion_hash;  ///< of the bytes of the motion.bin that was recorded with it
};

/// The bytes of manifest.json.
std::string manifest_text(const Golden& golden, const std::string& motion_hash);

/// The inverse. The text is as it was written, which a checksum tells, and every value is there, of its type and in a
/// range that makes sense.
/// @throws std::invalid_argument saying what is wrong with the bytes
Manifest read_manifest(std::string_view bytes);

/// A manifest of any values, with the checksum that belongs to them.
/// @throws std::invalid_argument if the text is no JSON object
std::string sealed_manifest(std::string_view text);

}  // namespace drape
