#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "audit/motion_audit.hpp"
#include "drape/render/settings.hpp"
#include "drape/scene/scene.hpp"
#include "motion/reader.hpp"
#include "reports/players.hpp"
#include "reports/result_table.hpp"
#include "run/progress.hpp"

namespace drape {

/// Options of an audit.
struct AuditOptions {
  double depth = audit::AuditLimits{}.depth;  ///< largest accepted depth of a vertex in a solid [m]
  std::optional<double> stretch;              ///< accepted stretch of an edge; absent: the scene's strain limit
  std::optional<std::int64_t> steps;          ///< last step to audit; absent: the whole motion
  std::optional<std::vector<int>> held;       ///< vertices that may rest; absent: the scene's pins
};

/// Energy balance of a motion.
struct EnergyAudit {
  std::string not_judged;               ///< reason why a rise is not judged, as a clause; empty: it was judged
  static constexpr double most = 0.02;  ///< tolerated gain relative to all energy, from inexact solves of steps

  double rise = 0;          ///< largest rise above the previous minimum [J]
  double of_available = 0;  ///< the rise relative to all energy that the cloth ever had
  double from = 0, to = 0;  ///< time of the rise [s]

  /// Returns true if the rise exceeds the tolerance of the solver.
  [[nodiscard]] bool found() const { return not_judged.empty() && of_available > most; }
};

/// Results of an audit.
struct AuditReport {
  std::string file;  ///< name of the motion or the scene, for display
  audit::AuditLimits limits;
  audit::MotionAudit findings;
  EnergyAudit energy;
  double duration = 0;          ///< time of the last state [s]
  bool gaps = false;            ///< states are more than a step or substep apart: the paths between them are no steps
  std::string divergence = {};  ///< reason for an early end of the simulation; empty: none
  bool interrupted = false;

  [[nodiscard]] bool clean() const { return findings.clean() && !energy.found(); }
};

/// Audits each state of a scene's motion, simulated or recorded.
/// @param recorded the motion, if it is in a file; null: simulate it
/// @throws UsageError if a state is non-finite or has invalid vertices
AuditReport audit_motion(const LoadedScene& scene, const std::shared_ptr<MotionReader>& recorded,
                         const AuditOptions& options, const std::stop_token& stop, Progress& progress);

/// Returns the name of a check for a table: "triangles that cross".
std::string check_name(audit::Check check);

/// Returns a row for each check, and notes on findings and omitted checks.
ResultTable audit_table(const AuditReport& report);

/// Returns the outcome in one sentence.
std::string audit_summary(const AuditReport& report);

/// Pictures of the worst state of a check: the whole cloth and a close view of the finding.
struct DrawnFinding {
  audit::Check check;
  std::string whole, close;   ///< PNG files
  html::PlayedMotion turned;  ///< interactive view; without frames if it is too large for a browser
};

/// Draws the worst state of each check with findings; the vertices concerned are red.
/// @throws UsageError, OutputError as Renderer
std::vector<DrawnFinding> draw_findings(const Scene& scene, const AuditReport& report, GlBackend backend);

/// Returns a self-contained page with the table of checks and the worst states.
/// @param command command that makes the page again
std::string audit_page(const AuditReport& report, const std::vector<DrawnFinding>& drawn, const std::string& command);

}  // namespace drape
