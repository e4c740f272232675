#pragma once

#include <string>
#include <vector>

namespace drape {

/// Registers the rows that compare a quasi-Newton step with a textbook Newton step of equal accuracy, on the homework's
/// 20×20 cloth with k = 180 and h = 0.02 s, with and without the sphere; returns their names.
std::vector<std::string> register_equal_accuracy();

}  // namespace drape
