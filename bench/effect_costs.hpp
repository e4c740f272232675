#pragma once

#include <string>
#include <vector>

namespace drape {

/// Registers a step of liu13 with and without each effect of the registry that takes time, as CASE/with and
/// CASE/without. Returns the names of the cases.
std::vector<std::string> register_effect_costs();

}  // namespace drape
