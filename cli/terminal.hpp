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
  std::size_t width = unlimited_width;  ///< of a line; of a file or a pipe that of COLUMNS, if it is exported
  bool color = false;
};

/// What standard output or standard error leads to.
Terminal terminal(std::FILE* stream, ColorMode mode);

enum class Ink { red, yellow, green, bold };

/// The text in a colour, where the terminal has colours.
std::string inked(std::string_view text, Ink ink, const Terminal& where);

/// Sends log messages to standard error, as "drape: message": wrapped, and with a prefix that shows how bad it is.
void log_to_terminal(ColorMode mode);

}  // namespace drape
