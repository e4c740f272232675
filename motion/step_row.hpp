#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/collider.hpp"
#include "sim/simulation.hpp"

namespace drape {

/// Statistics of a step.
struct StepRow {
  std::int64_t step = 0;  ///< 0: the start, which has only energies and colliders
  Energies energies;      ///< at its end [J]
  int iterations = 0;
  bool converged = true;
  std::int64_t substeps = 1;        ///< number of substeps
  std::optional<double> estimate;   ///< estimated error added by the step, if an accuracy is set [m]
  double residual = 0;              ///< ‖∇g‖ at its end [N]
  std::optional<double> error;      ///< estimated error of its solve, if available [m]
  std::vector<Collider> colliders;  ///< at its end, in the scene's order
};

}  // namespace drape
