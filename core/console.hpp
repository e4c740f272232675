#pragma once

#include <cstdio>
#include <mutex>
#include <string_view>

namespace drape {

/// Opens /dev/null on those of the three standard streams that are closed. Otherwise the next file that is opened takes
/// the place of one, and what is printed goes into it.
void open_standard_streams();

/// Prints text for a person, at once, with control characters escaped (escape_controls). What the stream does not take
/// is lost: telling must not cost the results that it tells of.
void print_text(std::FILE* stream, std::string_view text);

/// Prints text as it is: colours and cursor movements, and text that is escaped already.
/// @returns whether the stream took it
bool print_unescaped(std::FILE* stream, std::string_view text);

/// Held while text is printed. Who keeps libraries from printing for a while, and so everybody, holds it as long.
std::mutex& console_mutex();

/// Why standard output has lost text, or what is still buffered for it cannot be written: an error number, or 0. Of a
/// reader that has gone away (EPIPE) nothing is said: it has had enough.
int lost_output();

}  // namespace drape
