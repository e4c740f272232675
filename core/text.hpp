#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace drape {

/// Makes a text valid in every report. U+FFFD replaces each byte that is not UTF-8, each control character but newline
/// and tab (HTML and XML forbid them), and each character that only changes the direction of writing.
std::string printable(std::string_view text);

/// Makes a text safe to print on a terminal: it may hold names of files and folders. Writes as \x1b or \u202e: control
/// characters but line feeds, bytes that are not UTF-8, characters that only change the direction of writing, and the
/// start of a build server's commands. Idempotent.
std::string escape_controls(std::string_view text);

/// Returns a name for a message: as escape_controls(), and on one line.
std::string shown(std::string_view name);
inline std::string shown(const std::string& name) { return shown(std::string_view(name)); }
inline std::string shown(const char* name) { return shown(std::string_view(name)); }
std::string shown(const std::filesystem::path& file);

/// Formats a length [m] with three digits: "1.23 mm", "0.5 mm", "12 µm", "340 nm"; millimetres from 0.1 mm on.
std::string readable_length(double metres);

/// Encodes bytes as base64 (RFC 4648, section 4).
std::string base64(std::string_view bytes);

}  // namespace drape
