#pragma once

#include <string>
#include <vector>

#include "manual/command_text.hpp"
#include "scene/tables.hpp"

namespace drape {

// Return scripts that complete drape's commands, options and their values, the keys and values of --set and --vary, and
// the names of scene files.

std::string bash_completion(const CommandText& drape, const std::vector<TableText>& tables);
std::string zsh_completion(const CommandText& drape, const std::vector<TableText>& tables);
std::string fish_completion(const CommandText& drape, const std::vector<TableText>& tables);

}  // namespace drape
