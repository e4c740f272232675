#pragma once

#include <CLI/CLI.hpp>

namespace drape {

/// Adds examples to the help of every command.
void add_examples(CLI::App& app);

}  // namespace drape
