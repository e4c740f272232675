#pragma once

#include <string>

#include "check/report.hpp"

namespace drape {

/// Returns a check's results as Markdown for a GitHub job summary: a table of the scenes, failed ones first.
std::string github_summary(const CheckReport& report);

/// Returns a line for each failed scene, which GitHub shows beside the scene's file.
std::string github_annotations(const CheckReport& report);

}  // namespace drape
