#pragma once

#include <string>
#include <vector>

namespace drape {

/// Registers, for every effect of the registry that costs anything, a step of liu13 with it and the same step without
/// it, as CASE/with and CASE/without. Returns the names of the cases.
std::vector<std::string> register_effect_costs();

}  // namespace drape
