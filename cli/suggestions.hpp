#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>

namespace drape {

/// Explains a command line error and suggests a correction: another command or option, `drape render` for a scene in
/// place of a command, or `--set` for a key of the scene written as an option.
/// @param words the command line, from its second word on
std::string explain(const CLI::App& app, const CLI::ParseError& error, std::span<const char* const> words);

/// Returns the subcommand at a path of names, as in `study accuracy`.
/// @throws UsageError if there is none, with the nearest name
const CLI::App& find_command(const CLI::App& app, std::span<const std::string> names);

}  // namespace drape
