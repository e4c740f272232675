#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "manual/command_text.hpp"
#include "scene/tables.hpp"

namespace drape {

/// The name of the value of options that take key.path=value.
inline constexpr const char* key_and_value = "KEY=VALUE";

/// Calls `visit` for a command and for all below it.
void each_command(const CommandText& command, const std::function<void(const CommandText&)>& visit);

/// Calls `visit` for every key that a scene can have, with its path: "effects.wind.velocity".
void each_key(const std::vector<TableText>& tables,
              const std::function<void(const std::string&, const KeyText&)>& visit);

/// The options' longest names.
std::vector<std::string> option_names(const CommandText& command);
std::vector<std::string> subcommand_words(const CommandText& command);

/// What the first word behind a command may be, where its first positional is one of a few words.
std::vector<std::string> first_words(const CommandText& command);

/// Whether files of scenes can follow it.
bool takes_scenes(const CommandText& command);

/// A help's first clause, as one line that fits beside a name.
std::string brief(std::string text);

/// Between single quotes; each of `special` gets a backslash, and an apostrophe becomes `apostrophe`.
std::string single_quoted(const std::string& text, std::string_view special, const char* apostrophe);

}  // namespace drape
