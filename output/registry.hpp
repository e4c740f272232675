#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "output/format.hpp"

namespace drape {

/// Returns all formats.
const std::vector<OutputFormat>& output_formats();

/// Returns the format of a path by its extension in lower or upper case; null if there is none.
const OutputFormat* find_format(std::string_view path);

/// Returns the format of a path.
/// @throws UsageError that names the nearest extension and all valid ones
const OutputFormat& format_of(std::string_view path);

enum class FormatKinds { all, drawn, undrawn };

/// Returns the help for -o, one line per format of these kinds.
std::string output_help(FormatKinds kinds);

/// Returns the table of docs/outputs.md.
std::string output_reference();

}  // namespace drape
