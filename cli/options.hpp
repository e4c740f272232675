#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "output/registry.hpp"
#include "reports/diagram.hpp"
#include "run/frame_source.hpp"
#include "scene/values.hpp"

namespace drape {

/// Parses "5MB", "800 kB", "1.5GiB" or "5000" as bytes: k, M, G are powers of 1000; ki, Mi, Gi of 1024.
/// @param option option name for messages
/// @throws UsageError if it is anything else, or less than one byte
std::uint64_t parse_byte_count(const std::string& option, const std::string& text);

/// Parses "0,40,80" to ascending numbers; nothing for an empty text.
/// @throws UsageError for other texts
std::vector<int> parse_frame_list(const std::string& text);

/// Parses a range of frames "A..B".
/// @throws UsageError for other texts
FrameRange parse_frames(const std::string& text);

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

/// Accepts a text without line feeds and other control characters: a name for scripts and messages.
CLI::Validator on_one_line();

/// Accepts a finite number in the range.
CLI::Validator number_in(const Range& range);

/// Accepts a whole number in the range.
CLI::Validator whole_number_in(const Range& range);

/// Adds --quality, a short form of --set look.quality=….
/// @param overrides receives the value; must outlive the command
void add_quality_option(CLI::App& command, std::vector<std::string>& overrides);

/// Adds --style, shared by all subcommands that write diagrams as files.
void add_style_option(CLI::App& subcommand, FigureStyle& style);

}  // namespace drape
