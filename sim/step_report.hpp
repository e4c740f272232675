#pragma once

// Example:
//   const drape::Mesh square = drape::make_grid(2, 2);
//   drape::Simulation simulation({.cloth = drape::make_cloth(square, square, 1, 10, {})});
//   const drape::StepReport report = simulation.step();
//   if (!report.converged) std::printf("stopped after %d iterations", report.iterations);

#include <cstdint>
#include <optional>

namespace drape {

/// Report of how a step was computed.
struct StepReport {
  int iterations = 0;              ///< linear solves; 0 for a method that has none
  bool converged = true;           ///< true if the stopping rule and every motion filter converged within their limits
  double kept = 1;                 ///< fraction of the path to the last iterate that the step kept, see BackwardEuler
  double rise = 0;                 ///< largest increase of g in an iteration beyond rounding [J]: a fault
  std::int64_t substeps = 1;       ///< number of substeps, see SubstepScheme
  std::optional<double> estimate;  ///< error added by the step [m], if an accuracy is set
};

}  // namespace drape
