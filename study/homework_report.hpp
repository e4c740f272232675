#pragma once

#include "study/homework.hpp"
#include "study/report.hpp"

namespace drape {

/// Returns the report of a study for all output formats.
StudyReport homework_report(const HomeworkStudy& study);

}  // namespace drape
