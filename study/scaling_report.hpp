#pragma once

#include "study/report.hpp"
#include "study/scaling.hpp"

namespace drape {

/// The study as it is printed and written.
StudyReport scaling_report(const ScalingStudy& study);

}  // namespace drape
