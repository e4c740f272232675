#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/cloth.hpp"
#include "sim/system.hpp"

namespace drape::test {

/// E(x) = Σ k/2 (‖xᵢ − xⱼ‖ − L)² [J], as it is written.
double plain_energy(const std::vector<Spring>& springs, const Vertices& x);

/// ∇E(x), n×3 [N], as it is written; zero for a spring of zero length.
Vertices plain_gradient(const std::vector<Spring>& springs, const Vertices& x);

/// Where a cloth gets within a time, in the limit of small steps: the classical Runge-Kutta method of fourth order on
///   m ẍ = −∇E(x) + m a + m ln(d) ẋ,
/// whose last term is what v *= dʰ after every step becomes as h → 0.
/// @param acceleration a, of every vertex [m/s²]
/// @param damping      d, what is left of a velocity after one second
State exact_motion(const Cloth& cloth, const Eigen::Vector3d& acceleration, double damping, double duration, int steps);

}  // namespace drape::test
