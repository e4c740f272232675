#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace drape {

/// A width that no line reaches.
inline constexpr std::size_t unlimited_width = static_cast<std::size_t>(-1);

/// How many columns of a terminal a text takes: its code points.
std::size_t columns_of(std::string_view text);

/// Breaks lines at spaces so that they take at most `width` columns. What is continued is indented as its line is, and
/// by `hanging` more. A word that is longer stays whole, and so does every line where the indent leaves less than 20
/// columns.
std::string wrapped(std::string_view text, std::size_t width, std::size_t hanging = 0);

/// Wraps the help of a command, whose descriptions begin in column 30: there they are continued.
std::string wrapped_help(std::string_view text, std::size_t width);

}  // namespace drape
