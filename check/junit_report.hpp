#pragma once

#include <string>

#include "check/report.hpp"

namespace drape {

/// Returns JUnit XML for continuous-integration servers. Each scene has a test case for its motion and one for its
/// pictures, and two more if it was checked end to end.
std::string junit_report(const CheckReport& report);

}  // namespace drape
