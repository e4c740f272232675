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

/// What may stand after -o, a line for each format.
/// @param drawn whether those that must be drawn are among them
std::string output_help(bool drawn);

/// The table of docs/outputs.md.
std::string output_reference();

}  // namespace drape
