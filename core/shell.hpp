#pragma once

#include <string>

namespace drape {

/// Quotes a word for the shell if it needs quotes.
std::string shell_word(const std::string& word);

/// Quotes a file name for the shell and prefixes "./" if it begins with a dash, so that it cannot be an option.
std::string shell_file(const std::string& file);

}  // namespace drape
