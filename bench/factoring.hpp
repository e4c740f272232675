#pragma once

#include <string>
#include <vector>

namespace drape {

/// Registers the factorisation of the homework cloth's matrix, from its springs to the factor: CASE/fronts, by nested
/// dissection and dense fronts, and CASE/cholmod, its simplicial factor. Returns the names of the cases.
std::vector<std::string> register_factoring();

}  // namespace drape
