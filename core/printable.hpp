#pragma once

#include <string>
#include <string_view>

namespace drape {

/// A text that may come from a file, as a message shows it: control characters but line feeds are written as \x1b, so
/// that they neither end the message nor talk to the terminal.
std::string printable(std::string_view text);

}  // namespace drape
