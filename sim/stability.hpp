#pragma once

#include "sim/system.hpp"

namespace drape {

/// Returns the largest step h [s] for which semi-implicit Euler is stable in any motion: 2/√λ_max(M⁻¹L). This covers
/// the free vertices and the pins that are released at some time. L = Σ k (eᵢ − eⱼ)(eᵢ − eⱼ)ᵀ is the sum over springs
/// and pairs coupled by energies. It bounds every Hessian, so √λ_max bounds every frequency of the cloth. Upper bounds
/// for forces that depend on the position (an explicit push) are added to λ_max. The step is infinite if nothing acts
/// on free vertices.
///
/// λ_max is found by Lanczos iteration to a relative 1e-4 from below, plus the error bound of that value. The last
/// value is cached, as a scene is checked before it is simulated.
double safe_step(const System& system);

/// Returns the largest stable step of a vertex without springs under position-dependent forces [s], for schemes that
/// evaluate them once per step. Infinite if there are none or their slope is unknown.
double safe_step_of_pushes(const System& system);

/// Returns a bound on the ratio of stiffness and inertia to inertia, 1 + h² max (2 Σ k + c)/m over the free vertices. k
/// are the stiffnesses of springs and couplings there, and c bounds the energies of single vertices. The smallest
/// possible eigenvalue of the implicit step's matrix M/h² + L is m/h². By Gershgorin's theorem no eigenvalue exceeds it
/// by more than this ratio. So it bounds the condition number of that matrix and of every smaller Hessian. For flat
/// cloth, where only inertia resists motion across its plane, the bound is reached within a factor of about two.
double condition_bound(const System& system);

/// Value of condition_bound() beyond which double precision loses the inertia beside the springs.
inline constexpr double largest_condition = 1e14;

}  // namespace drape
