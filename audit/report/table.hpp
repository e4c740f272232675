#pragma once

#include <string>

#include "audit/report/audit_motion.hpp"
#include "figures/result_table.hpp"

namespace drape {

/// The name of a check in a table: "triangles that cross".
std::string check_name(audit::Check check);

/// The worst state of a check in a sentence: "at 0.4 s (step 40): 2 pairs; cloth edge 1 2 goes through …".
std::string describe_worst(audit::Check check, const audit::CheckFindings& found);

/// A row for each check, and notes on what was found and what was not judged.
ResultTable audit_table(const AuditReport& report);

/// The outcome in one sentence.
std::string audit_summary(const AuditReport& report);

}  // namespace drape
