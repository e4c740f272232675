#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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

/// Formats the time of a frame with two decimals, or as many as tell neighbouring frames apart: "0.284 s".
/// @param spacing time from a frame to the next [s]
std::string readable_time(double seconds, double spacing);

/// A width that no line reaches.
inline constexpr std::size_t unlimited_width = static_cast<std::size_t>(-1);

/// Returns the number of terminal columns of a text: its code points.
std::size_t columns_of(std::string_view text);

/// Breaks lines at spaces so that they take at most `width` columns. Continuations are indented as their line is, plus
/// `hanging`. A longer word stays whole, and so does every line whose indent leaves less than 20 columns.
std::string wrapped(std::string_view text, std::size_t width, std::size_t hanging = 0);

/// Wraps the help text of a command: descriptions begin in column 30 and continue there.
std::string wrapped_help(std::string_view text, std::size_t width);

/// Returns the number of insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`, each byte
/// being edited at most once (the optimal string alignment distance).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns the name in `names` with the least edit distance to `name`, the first of several; case is ignored, and '-',
/// '_' and ' ' are equal. Returns "" if more than a third of the name would have to change.
std::string nearest_name(std::string_view name, std::span<const std::string> names);

/// Returns the rest of a message about an unknown name: "; did you mean 'stiffness'?" if one is near, else
/// "; " + `kind` + " 'mesh', 'mass'", or "" if there are no names.
/// @param kind introduces the list, as in "the keys are"
std::string did_you_mean(std::string_view name, std::span<const std::string> names, std::string_view kind);

/// Returns "'mesh', 'mass', 'pins'".
std::string quoted_list(std::span<const std::string> names);

}  // namespace drape
