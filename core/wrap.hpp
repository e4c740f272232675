#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace drape {

/// A width that no line reaches.
inline constexpr std::size_t unlimited_width = static_cast<std::size_t>(-1);

/// Returns the number of terminal columns of a text: its code points.
std::size_t columns_of(std::string_view text);

/// Breaks lines at spaces so that they take at most `width` columns. Continuations are indented as their line is, plus
/// `hanging`. A longer word stays whole, and so does every line whose indent leaves less than 20 columns.
std::string wrapped(std::string_view text, std::size_t width, std::size_t hanging = 0);

/// Wraps the help text of a command: descriptions begin in column 30 and continue there.
std::string wrapped_help(std::string_view text, std::size_t width);

}  // namespace drape
