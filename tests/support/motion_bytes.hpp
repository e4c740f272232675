#pragma once

#include <string>

#include "check/golden_motion.hpp"

namespace drape::test {

/// Makes a motion.bin of arbitrary words, including invalid ones that pack_motion() cannot write.
inline std::string motion_bytes(const Words& words) { return "drape motion 2\n" + pack_words(words); }

}  // namespace drape::test
