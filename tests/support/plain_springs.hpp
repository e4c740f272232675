#pragma once

#include <Eigen/Core>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "sim/system.hpp"

namespace drape::test {

/// Computes E(x) = Σ k/2 (‖xᵢ − xⱼ‖ − L)² [J] literally.
double plain_energy(const std::vector<Spring>& springs, const Vertices& x);

/// Computes ∇E(x), n×3 [N], literally; zero for a spring of zero length.
Vertices plain_gradient(const std::vector<Spring>& springs, const Vertices& x);

/// Computes Σ k n̂ (n̂·(vᵢ − vⱼ)) over the springs with the directions n̂ at x, n×3, literally.
Vertices plain_dashpots(const std::vector<Spring>& springs, const Vertices& x, const Vertices& v);

/// Computes a cloth's state after a time in the limit of small steps, by the classical fourth-order Runge-Kutta method:
///   m ẍ = −∇E(x) + m a + m ln(d) ẋ − Σ τ k n̂ (n̂·(ẋᵢ − ẋⱼ)),
/// whose third term is the limit of v *= dʰ after every step as h → 0, and the last that of dashpots along the springs.
/// @param acceleration a, of every vertex [m/s²]
/// @param damping      d, fraction of a velocity that remains after one second
/// @param relaxation   τ [s]
State exact_motion(const Cloth& cloth, const Eigen::Vector3d& acceleration, double damping, double duration, int steps,
                   double relaxation = 0);

}  // namespace drape::test
