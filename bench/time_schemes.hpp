#pragma once

#include <string>
#include <vector>

namespace drape {

/// Registers what a motion of the homework's costs that is no further from the true one than an error, by the schemes
/// of second order and of first; returns the cases.
std::vector<std::string> register_time_schemes();

}  // namespace drape
