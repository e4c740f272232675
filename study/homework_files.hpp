#pragma once

#include <filesystem>
#include <string>

#include "study/homework.hpp"

namespace drape {

/// The study as text for a terminal, as Markdown, and as a page.
std::string homework_text(const HomeworkStudy& study);
std::string homework_markdown(const HomeworkStudy& study);
std::string homework_page(const HomeworkStudy& study);

/// Writes all of it into a folder: report.html, report.md, a CSV file for every table, and the plots.
/// @returns what could not be done, as a sentence; empty if all is there
/// @throws OutputError
std::string write_homework_files(const HomeworkStudy& study, const std::filesystem::path& folder);

}  // namespace drape
