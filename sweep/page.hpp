#pragma once

#include <filesystem>
#include <string>

#include "sweep/results.hpp"

namespace drape {

/// A self-contained page: the films in grids that play in step, diagrams of any figure over any axis, and the figures
/// of all runs in a table that can be sorted.
/// @param folder of the sweep, where the contact sheets of films are read
std::string sweep_page(const SweepResults& results, const std::filesystem::path& folder);

}  // namespace drape
