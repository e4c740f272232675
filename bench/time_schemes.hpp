#pragma once

#include <string>
#include <vector>

namespace drape {

/// Registers a motion of the homework computed to a given error, by schemes of second and of first order; returns the
/// cases.
std::vector<std::string> register_time_schemes();

/// Registers the motion of scene 3's cloth by the default method and by XPBD, whose steps are as many as its error
/// needs, as CASE/drape and CASE/xpbd. Returns the names of the cases.
std::vector<std::string> register_peers();

/// Registers the rows that compare a quasi-Newton step with a textbook Newton step of equal accuracy, on the homework's
/// 20×20 cloth with k = 180 and h = 0.02 s, with and without the sphere; returns their names.
std::vector<std::string> register_equal_accuracy();

/// Registers the factorisation of the homework cloth's matrix, from its springs to the factor: CASE/fronts, by nested
/// dissection and dense fronts, and CASE/cholmod, its simplicial factor. Returns the names of the cases.
std::vector<std::string> register_factoring();

/// Registers it beside CHOLMOD's supernodal factor, "fronts" and "supernodal".
std::vector<std::string> register_supernodal_factoring();

}  // namespace drape
