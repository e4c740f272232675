#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "audit/motion_audit.hpp"
#include "drape/sim/settings.hpp"
#include "drape/sim/state.hpp"

namespace drape::test {

/// Findings of the exact checker over all steps of a run, for the cloth with itself and with every body.
struct AuditedRun {
  int steps = 0;
  int with_passages = 0;   ///< steps with an intersection on the straight paths
  int with_crossings = 0;  ///< steps that end with an edge through a triangle
  double deepest = 0;      ///< greatest depth of a vertex in a closed body, a sphere or a ground after any step [m]
  State last;              ///< state at the end
  audit::EnergyRise rise;  ///< of the total energy, including all work
  std::vector<std::string> first;  ///< the first findings, at most ten: "step 3: cloth edge 1 2 meets …"
};

/// Simulates `steps` steps and audits each. Ends earlier once the process has used `most_seconds` of CPU time.
AuditedRun audit_run(const SimulationSettings& settings, std::int64_t steps,
                     double most_seconds = std::numeric_limits<double>::infinity());

}  // namespace drape::test
