#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace drape {

/// Adds --quality, which is short for --set look.quality=….
/// @param overrides to which it adds its value; must outlive the command
void add_quality_option(CLI::App& command, std::vector<std::string>& overrides);

}  // namespace drape
