#pragma once

#include <CLI/CLI.hpp>

namespace drape {

/// Accepts a text without line feeds and other control characters: a name for scripts and messages.
CLI::Validator on_one_line();

}  // namespace drape
