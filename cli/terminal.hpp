#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include "core/wrap.hpp"

namespace drape {

/// Use of colours. Automatic: on a terminal, unless NO_COLOR is set or TERM is "dumb".
enum class ColorMode { automatic, always, never };

/// Properties of a text destination.
struct Terminal {
  /// Line width. On a terminal: the smaller of the window's width (80 if unknown) and COLUMNS; for a file or a pipe:
  /// COLUMNS, if exported.
  std::size_t width = unlimited_width;
  bool color = false;
};

/// Returns the properties of standard output or standard error.
Terminal terminal(std::FILE* stream, ColorMode mode);

enum class Ink { red, yellow, green, bold };

/// Returns the text in a colour, if the terminal has colours.
std::string inked(std::string_view text, Ink ink, const Terminal& where);

/// Prints lines, wrapped at spaces to the stream's width. Continuation lines are indented.
void print_wrapped(std::FILE* stream, std::string_view lines);

/// Shows a temporary line; the next one replaces it, and logging or clearing erases it.
void show_transient_line(std::string_view line);
void clear_passing_line();

/// Sends log messages to standard error as "drape: message", wrapped and with a prefix for the severity.
void log_to_terminal(ColorMode mode);

}  // namespace drape
