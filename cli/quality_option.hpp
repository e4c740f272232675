#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace drape {

/// Adds --quality, a short form of --set look.quality=….
/// @param overrides receives the value; must outlive the command
void add_quality_option(CLI::App& command, std::vector<std::string>& overrides);

}  // namespace drape
