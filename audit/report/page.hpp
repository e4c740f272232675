#pragma once

#include <string>
#include <vector>

#include "audit/report/audit_motion.hpp"
#include "html/motion_player.hpp"
#include "render/backend.hpp"

namespace drape {

/// The worst state of a check, drawn: all of it, and the place where it was found.
struct DrawnFinding {
  audit::Check check;
  std::string whole, close;   ///< PNG files
  html::PlayedMotion turned;  ///< the state, to turn; without frames if a browser cannot hold it
};

/// Draws the worst state of each check that has found something, with the vertices concerned in red.
/// @throws UsageError, OutputError as Renderer
std::vector<DrawnFinding> draw_findings(const Scene& scene, const AuditReport& report, GlBackend backend);

/// A self-contained page: the table of the checks, and the worst states drawn.
/// @param command that makes it again
std::string audit_page(const AuditReport& report, const std::vector<DrawnFinding>& drawn, const std::string& command);

}  // namespace drape
