#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/format.hpp"

namespace drape {

/// Reads "4x3", columns and rows.
/// @param option whose value it is, for the message
/// @throws UsageError if it is none, or has more than 100 places in a row or column
SheetGrid parse_grid(const std::string& option, const std::string& text);

/// What --sheet is.
inline constexpr const char* sheet_help =
    "COLUMNSxROWS: a .png without {frame} shows so many moments of the film, evenly spread, instead of the last";

/// Reads the value of --sheet; nothing if it is empty.
/// @throws UsageError if it is no grid, or none of the outputs becomes a sheet
std::optional<SheetGrid> parse_sheet(const std::string& text, const std::vector<std::string>& outputs);

}  // namespace drape
