#pragma once

#include "study/homework.hpp"
#include "study/report.hpp"

namespace drape {

/// The study as it is printed and written.
StudyReport homework_report(const HomeworkStudy& study);

}  // namespace drape
