#pragma once

#include "study/report.hpp"
#include "study/scaling.hpp"

namespace drape {

/// Returns the report of a study for all output formats.
StudyReport scaling_report(const ScalingStudy& study);

}  // namespace drape
