#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace drape {

/// An option or a positional argument, for manuals and completions.
struct OptionText {
  std::vector<std::string> names;    ///< "-o", "--output"; for a positional only "SCENE"
  std::string value;                 ///< value placeholder, "FILE"; empty: no value
  std::vector<std::string> choices;  ///< accepted values, if they are a fixed set
  std::string help;                  ///< may have several lines
  bool positional = false, required = false, repeatable = false;
};

/// A command with its subcommands.
struct CommandText {
  std::string name;  ///< "drape study accuracy"
  std::string help, examples;
  std::vector<OptionText> options;
  std::vector<CommandText> subcommands;

  /// Returns the last word of the name: "accuracy".
  [[nodiscard]] std::string word() const { return name.substr(name.rfind(' ') + 1); }
};

/// Describes a command and its subcommands, without hidden ones. A value with a fixed set of words is named by them:
/// "auto|osmesa|egl".
CommandText describe_command(const CLI::App& app);

}  // namespace drape
