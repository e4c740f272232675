#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "scene/tables.hpp"

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

/// A manual page: file name, "drape-render.1", and text in man macros.
struct ManPage {
  std::string file, text;
};

/// Returns a page for drape and one for each of its commands, in section 1.
std::vector<ManPage> command_pages(const CommandText& drape);

/// Returns the page of the scene format, drape-scene(5).
ManPage scene_page(const std::vector<TableText>& tables);

}  // namespace drape
