#pragma once

#include <string>

#include "audit/report/audit_motion.hpp"
#include "figures/result_table.hpp"

namespace drape {

/// Returns the name of a check for a table: "triangles that cross".
std::string check_name(audit::Check check);

/// Describes the worst state of a check: "at 0.4 s (step 40): 2 pairs; cloth edge 1 2 goes through …".
std::string describe_worst(audit::Check check, const audit::CheckFindings& found);

/// Returns a row for each check, and notes on findings and omitted checks.
ResultTable audit_table(const AuditReport& report);

/// Returns the outcome in one sentence.
std::string audit_summary(const AuditReport& report);

}  // namespace drape
