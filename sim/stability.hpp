#pragma once

#include <optional>
#include <string>

#include "sim/settings.hpp"
#include "sim/system.hpp"

namespace drape {

/// The largest step h with which semi-implicit Euler is stable whatever the motion [s]: 2/√λ_max(M⁻¹L) over the free
/// vertices and the pins that are released at some time, L = Σ k (eᵢ − eⱼ)(eᵢ − eⱼ)ᵀ of the springs and of the bounds
/// of coupled energies. No Hessian exceeds its part of L, so no frequency of the cloth exceeds √λ_max. Infinite for a
/// cloth without springs on free vertices.
///
/// λ_max is found by Lanczos iteration to a relative 1e-4 from below, and the error bound of that value is added to it.
double safe_step(const System& system);

/// Why the settings' step makes the motion unstable, with the largest safe one: a sentence if the method is
/// semi-implicit Euler and the step is beyond safe_step(); nothing otherwise, and for the implicit methods.
std::optional<std::string> stability_problem(const SimulationSettings& settings, const System& system);

}  // namespace drape
