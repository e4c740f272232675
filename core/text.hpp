#pragma once

#include <string>
#include <string_view>

namespace drape {

/// A text that every report can hold: U+FFFD stands for each byte that is no UTF-8 and for each character that HTML or
/// XML does not allow, which are the control characters but for newline and tab.
std::string printable(std::string_view text);

/// A text that may come from a file, as a message shows it: control characters but line feeds are written as \x1b, so
/// that they neither end the message nor talk to the terminal.
std::string escape_controls(std::string_view text);

/// A length for people, with three digits: "1.23 mm", "0.5 mm", "12 µm", "340 nm"; millimetres from a tenth of one on.
std::string readable_length(double metres);

/// Bytes as text, see RFC 4648, section 4.
std::string base64(std::string_view bytes);

}  // namespace drape
