#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>

namespace drape {

/// What is wrong with a command line, and what was probably meant: another command or option, `drape render` for a
/// scene that stands where a command should, `--set` for a key of the scene that is written as an option.
/// @param words the command line, from its second word on
std::string explain(const CLI::App& app, const CLI::ParseError& error, std::span<const char* const> words);

/// The subcommand that some names lead to, as in `study accuracy`.
/// @throws UsageError if there is none, with the nearest
const CLI::App& find_command(const CLI::App& app, std::span<const std::string> names);

}  // namespace drape
