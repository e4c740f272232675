#pragma once

#include <string>

namespace drape {

/// A word as a shell takes it for one: between quotes if it has to be.
std::string shell_word(const std::string& word);

}  // namespace drape
