#pragma once

#include "study/homework.hpp"
#include "study/homework_cases.hpp"

namespace drape {

/// Looks at each conclusion of the report.
/// @param rows   homework_rows()
/// @param tables what they did, in the same order
/// @param extras what homework_extras() did
std::vector<Conclusion> judge_conclusions(const std::vector<HomeworkRow>& rows, const std::vector<Measured>& tables,
                                          const std::vector<Measured>& extras);

/// The row of a table that has this method and tolerance; "" is any tolerance.
/// @throws std::out_of_range if there is none
std::size_t find_row(const std::vector<HomeworkRow>& rows, int table, const std::string& method,
                     const std::string& tolerance = "");

/// Where drape differs from the report on purpose, a sentence each.
std::vector<std::string> homework_differences();

}  // namespace drape
