#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/collider.hpp"
#include "sim/simulation.hpp"

namespace drape {

/// What is known of a step beside where it ends.
struct StepRow {
  std::int64_t step = 0;  ///< 0: the start, of which only the energies and colliders are known
  Energies energies;      ///< where it ends [J]
  int iterations = 0;
  bool converged = true;
  std::int64_t substeps = 1;        ///< that it was cut into
  std::optional<double> estimate;   ///< of the error that it has added, where an accuracy was asked for [m]
  double residual = 0;              ///< ‖∇g‖ where it ends [N]
  std::optional<double> error;      ///< of its solve, where it was estimated [m]
  std::vector<Collider> colliders;  ///< at its end, in the order of the scene
};

}  // namespace drape
