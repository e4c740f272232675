#pragma once

#include "study/report.hpp"
#include "study/stability.hpp"

namespace drape {

/// The study as it is printed and written.
StudyReport stability_report(const StabilityStudy& study);

}  // namespace drape
