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

/// Describes a command and its subcommands, without hidden ones. The placeholder of a value with fixed choices lists
/// them: "auto|osmesa|egl".
CommandText describe_command(const CLI::App& app);

/// A manual page: file name, "drape-render.1", and text in man macros.
struct ManPage {
  std::string file, text;
};

/// Returns a page for drape and one for each of its commands, in section 1.
std::vector<ManPage> command_pages(const CommandText& drape);

/// Returns the page of the scene format, drape-scene(5).
ManPage scene_page(const std::vector<TableText>& tables);

/// A completion of the last word of a command line. If it ends in = or /, more follows in the same word.
struct Completion {
  std::string word;
  std::string help;  ///< one line, may be empty
};

/// Returns all completions of a command line's last word: commands, options and their values, keys and values of --set
/// and --vary, scene files and folders. Empty: any file may follow.
/// @param words the words after `drape`; the last one is incomplete, maybe empty
std::vector<Completion> completions(const CommandText& drape, const std::vector<TableText>& tables,
                                    const std::vector<std::string>& words);

/// Value placeholder of options that take key.path=value.
inline constexpr const char* key_and_value = "KEY=VALUE";

// Scripts for the shells. Each asks the program of the command line: `drape complete -- WORD...` prints a line for each
// completion, with its help after a tab.

inline constexpr const char* bash_completion = R"(# bash completion of drape, written by drape itself
_drape() {
  local line=${COMP_LINE:0:COMP_POINT} words current
  read -ra words <<<"$line"
  [[ $line == *[[:space:]] ]] && words+=("")
  current=${words[-1]}
  mapfile -t COMPREPLY < <("${words[0]}" complete -- "${words[@]:1}" 2>/dev/null | cut -f 1)
  [[ ${COMPREPLY[0]} == *[=/] ]] && compopt -o nospace 2>/dev/null
  # Where = ends a word, the part up to the last = is already on the line.
  [[ $COMP_WORDBREAKS == *=* && $current == *=* ]] && COMPREPLY=("${COMPREPLY[@]#"${current%=*}="}")
}
complete -o bashdefault -o default -F _drape drape
)";

inline constexpr const char* zsh_completion = R"(#compdef drape
# zsh completion of drape, written by drape itself
local line
local -a matches descriptions suffix
for line in "${(@f)$($words[1] complete -- "${(@)words[2,CURRENT]}" 2>/dev/null)}"; do
  [[ -n $line ]] || continue
  matches+=("${line%%$'\t'*}")
  descriptions+=("${line/$'\t'/  -- }")
done
if (( $#matches )); then
  [[ $matches[1] == *[=/] ]] && suffix=(-S '')
  compadd -l -d descriptions $suffix -a matches
else
  _files
fi
)";

inline constexpr const char* fish_completion = R"(# fish completion of drape, written by drape itself
function __drape_complete
  set -l words (commandline -opc) (commandline -ct)
  set -l matches ($words[1] complete -- $words[2..] 2>/dev/null)
  if count $matches >/dev/null
    printf '%s\n' $matches
  else
    __fish_complete_path (commandline -ct)
  end
end
complete -c drape -f -a '(__drape_complete)'
)";

}  // namespace drape
