#pragma once

#include <string>
#include <vector>

#include "cli/manual/man_pages.hpp"
#include "scene/tables.hpp"

namespace drape {

/// A completion of the last word of a command line. If it ends in = or /, more follows in the same word.
struct Completion {
  std::string word;
  std::string help;  ///< one line, may be empty
};

/// Returns all completions of a command line's last word: commands, options and their values, keys and values of --set
/// and
/// --vary, scene files and folders. Empty: any file may follow.
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
  # What stands before the last = is on the line already, where = ends a word.
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
