#pragma once

#include <optional>
#include <string>

#include "sim/settings.hpp"

namespace drape {

/// The method that a simulation takes whose settings name none.
struct MethodChoice {
  Method method = Method::quasi_newton;  ///< velocity Verlet or quasi-Newton
  int substeps = 1;                      ///< of a step by velocity Verlet, the fewest that are stable
  double verlet = 0;                     ///< estimated cost of a step by velocity Verlet, see estimated_step() [s]
  double quasi_newton = 0;               ///< estimated cost of two of quasi-Newton's, half as long [s]
  std::string reason;                    ///< ends a sentence that begins with "as": "the cheaper"
  bool only = false;                     ///< whether no other method can be taken

  /// Has the settings name it.
  void apply(SimulationSettings& settings) const;
};

/// Chooses between velocity Verlet in the fewest stable substeps of each step, and quasi-Newton. Verlet's error is far
/// below a hundredth of the cloth's size then (docs/accuracy.md); backward Euler's is about that with half the usual
/// step, so the cheaper of Verlet's step and twice quasi-Newton's is taken. Where the cloth can touch something,
/// impulses of an implicit step stretch stiff springs, which short steps avoid: there Verlet may cost ten times as
/// much. The choice follows from counted work alone, and is the same on every machine.
/// @param settings valid, but for their method
MethodChoice choose_method(const SimulationSettings& settings);

/// The method that settings imply which name none, but say how a step is solved: quasi-Newton, or implicit where it is
/// a linear solver that they name. Nothing where they do not.
std::optional<Method> implied_method(const IntegratorSettings& integrator);

/// The settings with the method that they name or imply, or else the one that is chosen.
SimulationSettings with_method(SimulationSettings settings);

/// The time that a step takes on a processor as they were in 2022, within a factor of about three [s].
/// @param substeps of a step by an explicit method
/// @param stiffness of the springs: how many substeps would be stable, for the number of iterations
double estimated_step(const SimulationSettings& settings, Method method, double substeps, double stiffness);

}  // namespace drape
