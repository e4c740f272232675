#include <fmt/format.h>
#include <fmt/ranges.h>

#include "manual/completion_words.hpp"
#include "manual/completions.hpp"

namespace drape {
namespace {

std::string fish_quoted(const std::string& text) { return single_quoted(text, "\\", "\\'"); }

/// Returns the condition for this command line: render, or study and accuracy, and no subcommand of it.
std::string condition(const CommandText& command) {
  std::string text;
  for (std::size_t at = command.name.find(' '); at != std::string::npos; at = command.name.find(' ', at + 1)) {
    const std::string word = command.name.substr(at + 1, command.name.find(' ', at + 1) - at - 1);
    text += (text.empty() ? "" : "; and ") + ("__fish_seen_subcommand_from " + word);
  }
  if (command.subcommands.empty()) return text;
  if (text.empty()) return "__fish_use_subcommand";
  return fmt::format("{}; and not __fish_seen_subcommand_from {}", text, fmt::join(subcommand_words(command), " "));
}

std::string fish_option(const OptionText& option, const std::string& start) {
  std::string text = start;
  for (const std::string& name : option.names) {
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.choices.empty()) {
    text += fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
  } else if (option.value == key_and_value) {
    text += " -x -a '(__drape_keys)'";
  } else if (!option.value.empty()) {
    text += " -r";
  }
  return text + " -d " + fish_quoted(brief(option.help)) + "\n";
}

}  // namespace

std::string fish_completion(const CommandText& drape, const std::vector<TableText>& tables) {
  std::string text = "# fish completion of drape, written by drape itself\nfunction __drape_keys\n  printf '%s\\n'";
  each_key(tables, [&](const std::string& path, const KeyText& key) {
    if (key.values.empty()) text += " " + path + "=";
    for (const std::string& value : key.values) text += " " + path + "=" + value;
  });
  text += "\nend\n";
  each_command(drape, [&](const CommandText& command) {
    const std::string start = fmt::format("complete -c drape -n '{}'", condition(command));
    if (!command.subcommands.empty()) text += start + " -f\n";
    for (const CommandText& one : command.subcommands) {
      text += fmt::format("{} -a {} -d {}\n", start, one.word(), fish_quoted(brief(one.help)));
    }
    if (const auto words = first_words(command); !words.empty()) {
      text += fmt::format("{} -a '{}'\n", start, fmt::join(words, " "));
    }
    if (takes_scenes(command)) text += start + " -k -a '(__fish_complete_suffix .toml)'\n";
    // Options shared by all commands belong to drape itself and complete after any command.
    for (const OptionText& option : command.options) {
      if (!option.positional) text += fish_option(option, &command == &drape ? "complete -c drape" : start);
    }
  });
  return text;
}

}  // namespace drape
