#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace drape {

/// A text that every report can hold: U+FFFD stands for each byte that is no UTF-8, for each character that HTML or
/// XML does not allow, which are the control characters but for newline and tab, and for each that only turns the
/// direction of writing.
std::string printable(std::string_view text);

/// A text as it is printed, which may hold names from files and folders. Written as \x1b or \u202e are: control
/// characters but line feeds, bytes that are no UTF-8, characters that only turn the direction of writing, and the
/// begin of what a build server takes for a command. So no name talks to the terminal. Applying it twice changes
/// nothing.
std::string escape_controls(std::string_view text);

/// A name in a message: as escape_controls(), and on one line.
std::string shown(std::string_view name);
inline std::string shown(const std::string& name) { return shown(std::string_view(name)); }
inline std::string shown(const char* name) { return shown(std::string_view(name)); }
std::string shown(const std::filesystem::path& file);

/// A length for people, with three digits: "1.23 mm", "0.5 mm", "12 µm", "340 nm"; millimetres from a tenth of one on.
std::string readable_length(double metres);

/// Bytes as text, see RFC 4648, section 4.
std::string base64(std::string_view bytes);

}  // namespace drape
