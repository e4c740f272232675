#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "audit/motion_audit.hpp"
#include "motion/reader.hpp"
#include "run/progress.hpp"
#include "scene/scene.hpp"

namespace drape {

/// How a motion is audited.
struct AuditOptions {
  double depth = audit::AuditLimits{}.depth;  ///< of a vertex in a solid that is no finding [m]
  std::optional<double> stretch;              ///< of an edge likewise; absent: the scene's strain limit, if it has one
  std::optional<std::int64_t> steps;          ///< audit the motion up to this step; absent: all of it
  std::optional<std::vector<int>> held;       ///< vertices that may stand still; absent: the scene's pins
};

/// The energy of a motion over its steps.
struct EnergyAudit {
  std::string not_judged;               ///< why a rise has a cause or none is known, as a clause; empty: it was judged
  static constexpr double most = 0.02;  ///< of all energy, which steps that are solved loosely may gain

  double rise = 0;          ///< the largest over the least before it [J]
  double of_available = 0;  ///< that rise by all energy that the cloth ever had
  double from = 0, to = 0;  ///< when it rose [s]

  /// True where the rise is more than the tolerance of a step explains.
  [[nodiscard]] bool found() const { return not_judged.empty() && of_available > most; }
};

/// All that an audit has found.
struct AuditReport {
  std::string file;  ///< of the motion or the scene, as it is shown
  audit::AuditLimits limits;
  audit::MotionAudit findings;
  EnergyAudit energy;
  double duration = 0;          ///< up to the last state [s]
  bool gaps = false;            ///< states are more than a step apart, so the ways between them are no steps
  std::string divergence = {};  ///< why the simulation ended early; empty: it did not
  bool interrupted = false;

  [[nodiscard]] bool clean() const { return findings.clean() && !energy.found(); }
};

/// Audits each state of a scene's motion: simulates it, or reads it where it is recorded.
/// @param recorded the motion, if it is in a file; null: it is simulated
/// @throws UsageError if a state is not finite or names vertices that there are not
AuditReport audit_motion(const Scene& scene, const std::shared_ptr<MotionReader>& recorded, const AuditOptions& options,
                         const std::stop_token& stop, Progress& progress);

}  // namespace drape
