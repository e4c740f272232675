#pragma once

#include <string>
#include <vector>

#include "audit/report/audit_motion.hpp"
#include "html/motion_player.hpp"
#include "render/backend.hpp"

namespace drape {

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
