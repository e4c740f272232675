#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "manual/command_text.hpp"
#include "scene/tables.hpp"

namespace drape {

/// Value placeholder of options that take key.path=value.
inline constexpr const char* key_and_value = "KEY=VALUE";

/// Calls `visit` for a command and all commands below it.
void each_command(const CommandText& command, const std::function<void(const CommandText&)>& visit);

/// Calls `visit` for every key of a scene with its path: "effects.wind.velocity".
void each_key(const std::vector<TableText>& tables,
              const std::function<void(const std::string&, const KeyText&)>& visit);

/// Returns the longest name of each option.
std::vector<std::string> option_names(const CommandText& command);
std::vector<std::string> subcommand_words(const CommandText& command);

/// Returns the accepted words of the first positional argument, if they are a fixed set.
std::vector<std::string> first_words(const CommandText& command);

/// Returns true if scene files can follow the command.
bool takes_scenes(const CommandText& command);

/// Returns the first clause of a help text, shortened to one line beside a name.
std::string brief(std::string text);

/// Returns the text in single quotes; each of `special` gets a backslash, and an apostrophe becomes `apostrophe`.
std::string single_quoted(const std::string& text, std::string_view special, const char* apostrophe);

}  // namespace drape
