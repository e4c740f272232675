#pragma once

#include <array>
#include <vector>

namespace drape {

/// Returns the exponent p of the best fit y = c xᵖ: the least-squares slope of the points' logarithms. Points that are
/// not positive are ignored.
/// @returns NaN with fewer than two different x
double fitted_exponent(const std::vector<std::array<double, 2>>& points);

}  // namespace drape
