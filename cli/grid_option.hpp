#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/format.hpp"

namespace drape {

/// Parses "4x3", columns and rows.
/// @param option option name for messages
/// @throws UsageError for other texts, or more than 100 columns or rows
SheetGrid parse_grid(const std::string& option, const std::string& text);

/// Help of --sheet.
inline constexpr const char* sheet_help =
    "COLUMNSxROWS: a .png without {frame} shows so many moments of the film, evenly spread, instead of the last";

/// Parses the value of --sheet; nothing if it is empty.
/// @throws UsageError if it is not a grid, or no output becomes a sheet
std::optional<SheetGrid> parse_sheet(const std::string& text, const std::vector<std::string>& outputs);

}  // namespace drape
