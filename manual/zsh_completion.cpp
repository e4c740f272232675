#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "manual/completion_words.hpp"
#include "manual/completions.hpp"

namespace drape {
namespace {

constexpr const char* key_function = R"(
_drape_key_value() {
  if compset -P '*='; then
    local key=${${IPREFIX%=}##*=}
    compadd -- ${=_drape_key_values[$key]}
  else
    compadd -S = -- $_drape_keys
  fi
}
)";

/// Returns a help text beside an option: '[description]'.
std::string bracketed(const std::string& help) {
  const std::string text = single_quoted(brief(help), "[]\\", "'\\''");
  return fmt::format("'[{}]'", text.substr(1, text.size() - 2));
}

std::string function_name(const CommandText& command) {
  std::string name = "_" + command.name + "_command";
  std::ranges::replace(name, ' ', '_');
  return name;
}

/// Returns the value specification of an option for zsh's _arguments.
std::string zsh_value(const OptionText& option) {
  if (option.value.empty()) return {};
  if (!option.choices.empty()) return fmt::format("':value:({})'", fmt::join(option.choices, " "));
  return option.value == key_and_value ? "':key and value:_drape_key_value'"
                                       : fmt::format("':{}:_files'", option.value);
}

std::string zsh_options(const CommandText& command) {
  std::string text;
  for (const OptionText& option : command.options) {
    if (option.positional) continue;
    for (const std::string& name : option.names) {
      text += fmt::format(" \\\n    {}{}{}{}", option.repeatable ? "'*'" : "", name, bracketed(option.help),
                          zsh_value(option));
    }
  }
  return text;
}

std::string zsh_function(const CommandText& command) {
  std::string text = fmt::format("\n{}() {{\n", function_name(command));
  if (command.subcommands.empty()) {
    std::string rest = takes_scenes(command) ? "'*:scene:_files -g \"*.(toml|drape)\"'" : "'*: :_files'";
    if (const auto words = first_words(command); !words.empty()) {
      rest = fmt::format("'1: :({})' {}", fmt::join(words, " "), rest);
    }
    return text + "  _arguments -s" + zsh_options(command) + " \\\n    " + rest + "\n}\n";
  }
  text += "  local curcontext=$curcontext state line\n  typeset -A opt_args\n  _arguments -C" + zsh_options(command) +
          " \\\n    '1: :->command' '*:: :->arguments'\n  case $state in\n    command)\n      local -a commands=(";
  for (const CommandText& one : command.subcommands) {
    text += "\n        " + single_quoted(one.word() + ":" + brief(one.help), "", "'\\''");
  }
  text += ")\n      _describe command commands ;;\n    arguments)\n      case $words[1] in\n";
  for (const CommandText& one : command.subcommands) {
    text += fmt::format("        {}) {} ;;\n", one.word(), function_name(one));
  }
  return text + "      esac ;;\n  esac\n}\n";
}

}  // namespace

std::string zsh_completion(const CommandText& drape, const std::vector<TableText>& tables) {
  std::string keys, values, functions;
  each_key(tables, [&](const std::string& path, const KeyText& key) {
    keys += " " + path;
    if (!key.values.empty()) values += fmt::format("  {} '{}'\n", path, fmt::join(key.values, " "));
  });
  each_command(drape, [&](const CommandText& command) { functions += zsh_function(command); });
  return "#compdef drape\n# zsh completion of drape, written by drape itself\ntypeset -ga _drape_keys=(" + keys +
         " )\ntypeset -gA _drape_key_values=(\n" + values + ")\n" + key_function + functions + "\n" +
         function_name(drape) + " \"$@\"\n";
}

}  // namespace drape
