#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "output/format.hpp"

namespace drape {

/// Every format there is.
const std::vector<OutputFormat>& output_formats();

/// The format of an output's path, by its extension in small or capital letters; null: there is none.
const OutputFormat* find_format(std::string_view path);

/// The same.
/// @throws UsageError that names the nearest extension and all valid ones
const OutputFormat& format_of(std::string_view path);

enum class FormatKinds { all, drawn, undrawn };

/// What may stand after -o, a line for each format of these kinds.
std::string output_help(FormatKinds kinds);

/// The table of docs/outputs.md.
std::string output_reference();

}  // namespace drape
