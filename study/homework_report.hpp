#pragma once

#include "study/homework.hpp"
#include "study/report.hpp"

namespace drape {

/// Tests each conclusion of the report.
/// @param rows   homework_rows()
/// @param tables measurements of these rows, in the same order
/// @param extras measurements of homework_extras()
std::vector<Conclusion> judge_conclusions(const std::vector<HomeworkRow>& rows, const std::vector<Measured>& tables,
                                          const std::vector<Measured>& extras);

/// Returns the row of a table with this method and tolerance; "" matches any tolerance.
/// @throws std::out_of_range if there is none
std::size_t find_row(const std::vector<HomeworkRow>& rows, int table, const std::string& method,
                     const std::string& tolerance = "");

/// Returns the intended differences between drape and the report, one sentence each.
std::vector<std::string> homework_differences();

/// Returns the report of a study for all output formats.
StudyReport homework_report(const HomeworkStudy& study);

}  // namespace drape
