#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace drape {

/// An option, or a positional, as manuals and completions show it.
struct OptionText {
  std::vector<std::string> names;    ///< "-o", "--output"; of a positional its only one, "SCENE"
  std::string value;                 ///< what is written after it: "FILE"; empty: nothing
  std::vector<std::string> choices;  ///< what that may be, where it is one of a few words
  std::string help;                  ///< may have several lines
  bool positional = false, required = false, repeatable = false;
};

/// A command with its subcommands.
struct CommandText {
  std::string name;  ///< "drape study accuracy"
  std::string help, examples;
  std::vector<OptionText> options;
  std::vector<CommandText> subcommands;

  /// Its last word: "accuracy".
  [[nodiscard]] std::string word() const { return name.substr(name.rfind(' ') + 1); }
};

/// Everything that a command says of itself, but for what is hidden. The name of a value that is one of a few words
/// lists them, "auto|osmesa|egl".
CommandText describe_command(const CLI::App& app);

}  // namespace drape
