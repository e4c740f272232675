#pragma once

#include <string>

#include "check/words.hpp"

namespace drape::test {

/// A motion.bin of any words, which pack_motion() need not be able to make.
inline std::string motion_bytes(const Words& words) { return "drape motion 2\n" + pack_words(words); }

}  // namespace drape::test
