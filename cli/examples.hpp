#pragma once

#include <CLI/CLI.hpp>

namespace drape {

/// Puts examples at the end of the help of every command.
void add_examples(CLI::App& app);

}  // namespace drape
