#pragma once

#include <array>
#include <vector>

namespace drape {

/// The exponent p of y = c xᵖ that fits points (x, y) best: the slope of the line through their logarithms, by least
/// squares. Points that are not positive have no logarithm and do not count.
/// @returns not a number unless two points with different x are left
double fitted_exponent(const std::vector<std::array<double, 2>>& points);

}  // namespace drape
