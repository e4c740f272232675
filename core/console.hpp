#pragma once

#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>

namespace drape {

/// Opens /dev/null on each closed standard stream. Otherwise the next opened file would get its descriptor, and printed
/// text would go into that file.
void open_standard_streams();

/// Prints text at once, with control characters escaped (escape_controls). Text that the stream rejects is lost, so
/// that a failing message never costs the results.
void print_text(std::FILE* stream, std::string_view text);

/// Prints text unchanged: colours, cursor movements, and text that is escaped already.
/// @returns true if the stream took it
bool print_unescaped(std::FILE* stream, std::string_view text);

/// Returns the mutex that is held while text is printed, and while a library's output is silenced.
std::mutex& console_mutex();

/// Returns the error number if standard output lost text or cannot be flushed, otherwise 0. A reader that closed the
/// pipe (EPIPE) is no error.
int lost_output();

/// Quotes a word for the shell if it needs quotes.
std::string shell_word(const std::string& word);

/// Quotes a file name for the shell and prefixes "./" if it begins with a dash, so that it cannot be an option.
std::string shell_file(const std::string& file);

}  // namespace drape
