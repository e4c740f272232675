#pragma once

#include <string>

#include "check/report.hpp"

namespace drape {

/// What a check found, as Markdown for the summary of a GitHub job: a table of the scenes, those that failed first.
std::string github_summary(const CheckReport& report);

/// A line for each scene that failed, which GitHub shows beside the scene's file.
std::string github_annotations(const CheckReport& report);

}  // namespace drape
