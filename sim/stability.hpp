#pragma once

#include "sim/system.hpp"

namespace drape {

/// The largest step h with which semi-implicit Euler is stable whatever the motion [s]: 2/√λ_max(M⁻¹L) over the free
/// vertices and the pins that are released at some time, L = Σ k (eᵢ − eⱼ)(eᵢ − eⱼ)ᵀ of the springs and of the pairs
/// that energies couple. No Hessian exceeds its part of L, so no frequency of the cloth exceeds √λ_max. What forces
/// that depend on the place (an explicit push) add to it at most is added to λ_max. Infinite where nothing pulls on
/// free vertices.
///
/// λ_max is found by Lanczos iteration to a relative 1e-4 from below, and the error bound of that value is added to it.
/// It is remembered until another one is asked for, as a scene is checked before it is simulated.
double safe_step(const System& system);

/// That of a vertex without springs under the forces which depend on its place [s], with every scheme that evaluates
/// them once in a step; infinite where there are none, or where nobody knows how steep one is.
double safe_step_of_pushes(const System& system);

/// How much smaller the inertia of a vertex is than what holds it, 1 + h² max (2 Σ k + c)/m over the free vertices, k
/// the stiffness of the springs and couplings there and c the bounds of energies of single vertices. By Gershgorin's
/// theorem no eigenvalue of the implicit step's matrix M/h² + L exceeds its smallest possible one, m/h², by more, so it
/// bounds the condition of that matrix and of every Hessian below it. Where the cloth is flat, nothing but inertia
/// moves it across its plane, and the bound is reached within a factor of about two.
double condition_bound(const System& system);

/// Beyond this condition_bound() double precision no longer holds the inertia beside the springs.
inline constexpr double largest_condition = 1e14;

}  // namespace drape
