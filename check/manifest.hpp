#pragma once

#include <string>
#include <string_view>

#include "check/golden.hpp"

namespace drape {

/// The contents of manifest.json.
struct Manifest {
  Golden golden;            ///< all but the windows, and the positions in the frames
  std::string motion_hash;  ///< hash of the motion.bin recorded with it
};

/// Returns the text of manifest.json.
std::string manifest_text(const Golden& golden, const std::string& motion_hash);

/// Parses a manifest. A checksum detects modified text; every value must be present, with its type and a sensible
/// range.
/// @throws std::invalid_argument that describes the error in the bytes
Manifest read_manifest(std::string_view bytes);

/// Adds a valid checksum to a manifest with any values.
/// @throws std::invalid_argument if the text is no JSON object
std::string sealed_manifest(std::string_view text);

}  // namespace drape
