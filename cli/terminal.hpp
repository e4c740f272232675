#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include "core/wrap.hpp"

namespace drape {

/// Whether text has colours: at a terminal, unless NO_COLOR is set or TERM is "dumb"; or as --color says.
enum class ColorMode { automatic, always, never };

/// Where text is shown.
struct Terminal {
  /// Of a line: the smaller of the window's, 80 where that is unknown, and of COLUMNS; of a file or a pipe that of
  /// COLUMNS, if it is exported.
  std::size_t width = unlimited_width;
  bool color = false;
};

/// What standard output or standard error leads to.
Terminal terminal(std::FILE* stream, ColorMode mode);

enum class Ink { red, yellow, green, bold };

/// The text in a colour, where the terminal has colours.
std::string inked(std::string_view text, Ink ink, const Terminal& where);

/// Prints lines, broken at spaces where they are wider than the stream's window. What is continued is indented.
void print_wrapped(std::FILE* stream, std::string_view lines);

/// Shows a line that the next one takes the place of, as does whatever is logged or cleared.
void show_passing_line(std::string_view line);
void clear_passing_line();

/// Sends log messages to standard error, as "drape: message": wrapped, and with a prefix that shows how bad it is.
void log_to_terminal(ColorMode mode);

}  // namespace drape
