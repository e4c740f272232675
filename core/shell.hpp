#pragma once

#include <string>

namespace drape {

/// A word as a shell takes it for one: between quotes if it has to be.
std::string shell_word(const std::string& word);

/// A file as a word of a command, which takes no name for an option.
std::string shell_file(const std::string& file);

}  // namespace drape
