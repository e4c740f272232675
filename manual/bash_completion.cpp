#include <fmt/format.h>
#include <fmt/ranges.h>

#include "manual/completion_words.hpp"
#include "manual/completions.hpp"

namespace drape {
namespace {

constexpr const char* bash_body = R"(
# The words of the line that bash would take apart at = and : are put together again.
_drape() {
  local line=${COMP_LINE:0:COMP_POINT} words command=drape word current previous attached= values= kind=
  read -ra words <<<"$line"
  [[ $line == *[[:space:]] ]] && words+=("")
  current=${words[-1]} previous=${words[-2]}
  for word in "${words[@]:1:${#words[@]}-2}"; do
    [[ ${_drape_commands[$command]} == *" $word "* ]] && command+=" $word"
  done
  if [[ $current == --*=* ]]; then
    previous=${current%%=*} attached=$previous= current=${current#*=}
  fi
  kind=${_drape_values[$command $previous]}
  if [[ $kind == " keys " && $current == *=* ]]; then
    attached+=${current%%=*}= values=${_drape_key_values[${current%%=*}]} current=${current#*=}
  elif [[ $kind == " keys " ]]; then
    values=$_drape_keys
    compopt -o nospace 2>/dev/null
  elif [[ $kind ]]; then
    values=$kind
  elif [[ $current == -* ]]; then
    values="${_drape_options[$command]} ${_drape_options[drape]}"
  elif [[ $previous != -* && ${_drape_commands[$command]} ]]; then
    values=${_drape_commands[$command]}
  elif [[ $previous == "${command##* }" && ${_drape_words[$command]} ]]; then
    values=${_drape_words[$command]}
  elif [[ $previous != -o && ${_drape_scenes[$command]} ]]; then
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -d -- "$current"; compgen -f -X '!*.toml' -- "$current"; compgen -f -X '!*.drape' -- "$current")
    return
  fi
  mapfile -t COMPREPLY < <(compgen -W "$values" -P "$attached" -- "$current")
  # What stands before the last = is on the line already, where = ends a word.
  if [[ $attached == *=* && $COMP_WORDBREAKS == *=* ]]; then
    COMPREPLY=("${COMPREPLY[@]#"$attached"}")
  fi
}
complete -o bashdefault -o default -F _drape drape
)";

/// Returns an associative array of the script.
std::string table(const char* name, const std::string& rows) {
  return fmt::format("declare -gA {}=(\n{})\n", name, rows);
}

std::string row(const std::string& index, const std::vector<std::string>& words) {
  return fmt::format("  ['{}']=' {} '\n", index, fmt::join(words, " "));
}

}  // namespace

std::string bash_completion(const CommandText& drape, const std::vector<TableText>& tables) {
  std::string commands, options, words, scenes, values, key_values, keys;
  each_command(drape, [&](const CommandText& command) {
    if (!command.subcommands.empty()) commands += row(command.name, subcommand_words(command));
    if (!first_words(command).empty()) words += row(command.name, first_words(command));
    options += row(command.name, option_names(command));
    if (takes_scenes(command)) scenes += row(command.name, {"yes"});
    for (const OptionText& option : command.options) {
      for (const std::string& name : option.names) {
        if (!option.choices.empty()) values += row(command.name + " " + name, option.choices);
        if (option.value == key_and_value) values += row(command.name + " " + name, {"keys"});
      }
    }
  });
  each_key(tables, [&](const std::string& path, const KeyText& key) {
    keys += " " + path + "=";
    if (!key.values.empty()) key_values += row(path, key.values);
  });
  return "# bash completion of drape, written by drape itself\n" + table("_drape_commands", commands) +
         table("_drape_options", options) + table("_drape_words", words) + table("_drape_scenes", scenes) +
         table("_drape_values", values) + table("_drape_key_values", key_values) + "_drape_keys='" + keys + "'\n" +
         bash_body;
}

}  // namespace drape
