#pragma once

#include <string>
#include <vector>

namespace drape {

/// Registers a motion of the homework computed to a given error, by schemes of second and of first order; returns the
/// cases.
std::vector<std::string> register_time_schemes();

}  // namespace drape
