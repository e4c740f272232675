#pragma once

#include <CLI/CLI.hpp>

namespace drape {

/// Takes a text without line feeds and other control characters: a name that drape writes into scripts and messages.
CLI::Validator on_one_line();

}  // namespace drape
