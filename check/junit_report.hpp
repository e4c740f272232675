#pragma once

#include <string>

#include "check/report.hpp"

namespace drape {

/// JUnit XML, as continuous-integration servers read it: of every scene a test case for its motion and one for its
/// pictures, and two more if it was checked end to end.
std::string junit_report(const CheckReport& report);

}  // namespace drape
