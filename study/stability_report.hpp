#pragma once

#include "study/report.hpp"
#include "study/stability.hpp"

namespace drape {

/// Returns the report of a study for all output formats.
StudyReport stability_report(const StabilityStudy& study);

}  // namespace drape
