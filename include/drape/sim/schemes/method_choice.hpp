#pragma once

#include <optional>
#include <span>
#include <string>

#include "drape/sim/settings.hpp"

namespace drape {

/// The method chosen for settings that name none.
struct MethodChoice {
  Method method = Method::quasi_newton;  ///< velocity Verlet or quasi-Newton
  int substeps = 1;                      ///< stable substeps per step of velocity Verlet, as few as possible
  double verlet = 0;                     ///< estimated time of a step of velocity Verlet, see estimated_step() [s]
  double quasi_newton = 0;               ///< estimated time of two half steps of quasi-Newton [s]
  double contact = 0;                    ///< part of `quasi_newton` for contact, if the cloth touches something [s]
  std::string reason;                    ///< completes a sentence after "as": "the cheaper"
  bool only = false;                     ///< true if no other method is possible
  bool adapts = false;                   ///< true if an accuracy determines the substeps of every step

  /// Sets the method in the settings.
  void apply(SimulationSettings& settings) const;
};

/// Chooses between quasi-Newton and velocity Verlet with the fewest stable substeps. With these substeps, Verlet's
/// error is far below a hundredth of the cloth's size (docs/notes/accuracy.md). Backward Euler needs half the usual
/// step to reach a hundredth, so Verlet's step competes with two steps of quasi-Newton and the cheaper is taken. The
/// choice depends only on counted work and is the same on every machine.
/// @param settings valid except for their method
MethodChoice choose_method(const SimulationSettings& settings);

/// Returns a common method for runs to be compared: their present one if equal, otherwise the possible one with the
/// smallest total time. Returns nothing if no method suits all runs.
std::optional<Method> shared_method(std::span<const MethodChoice> choices);

/// Returns the method implied by solver settings: implicit for a linear solver, otherwise quasi-Newton. Returns nothing
/// without such settings.
std::optional<Method> implied_method(const IntegratorSettings& integrator);

/// Returns the settings with their named, implied or chosen method.
SimulationSettings with_method(SimulationSettings settings);

/// Returns the time for a step on a processor of 2022, within a factor of about three [s].
/// @param substeps per step, for explicit methods
/// @param stiffness of the springs, as the number of stable substeps; determines the number of iterations
double estimated_step(const SimulationSettings& settings, Method method, double substeps, double stiffness);

/// Returns the additional time of a step while the cloth touches something; 0 if no effect can touch it [s].
double estimated_contact(const SimulationSettings& settings, Method method);

}  // namespace drape
