#pragma once

#include <string>
#include <vector>

namespace drape {

/// Registers what getting from the springs of the homework's cloth to a factor of its matrix takes: CASE/fronts, by
/// nested dissection and dense fronts, and CASE/cholmod, its simplicial factor. Returns the names of the cases.
std::vector<std::string> register_factoring();

}  // namespace drape
