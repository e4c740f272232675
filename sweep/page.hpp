#pragma once

#include <filesystem>
#include <string>

#include "sweep/results.hpp"

namespace drape {

/// Returns a self-contained page: grids of synchronised films, diagrams of figures over axes, and a sortable table of
/// all runs with their figures.
/// @param folder of the sweep, with the contact sheets of films
std::string sweep_page(const SweepResults& results, const std::filesystem::path& folder);

}  // namespace drape
