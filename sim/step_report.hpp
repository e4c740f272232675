#pragma once

// Example:
//   const drape::Mesh square = drape::make_grid(2, 2);
//   drape::Simulation simulation({.cloth = drape::make_cloth(square, square, 1, 10, {})});
//   const drape::StepReport report = simulation.step();
//   if (!report.converged) std::printf("stopped after %d iterations", report.iterations);

#include <cstdint>
#include <optional>

namespace drape {

/// How a step was computed.
struct StepReport {
  int iterations = 0;     ///< linear solves; 0 for a method that has none
  bool converged = true;  ///< whether the stopping rule was met within max_iterations, and every motion filter's too
  double kept = 1;        ///< the fraction of the way to the last iterate that the step took, see BackwardEuler
  double rise = 0;        ///< the largest increase of g in an iteration that rounding does not explain [J]: a fault
  std::int64_t substeps = 1;       ///< that the step was cut into, see SubstepScheme
  std::optional<double> estimate;  ///< of the error that the step has added [m], where an accuracy is asked for
};

}  // namespace drape
