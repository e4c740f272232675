#pragma once

#include <CLI/CLI.hpp>

#include "reports/figure_style.hpp"

namespace drape {

/// Adds --style, shared by all subcommands that write diagrams as files.
void add_style_option(CLI::App& subcommand, FigureStyle& style);

}  // namespace drape
