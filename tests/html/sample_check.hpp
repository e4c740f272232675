#pragma once

#include "check/report.hpp"

namespace drape::test {

/// The report of a check of three scenes, with pictures that drape drew.
/// @param failing one scene changed and one had no golden; else all are as they were
CheckReport sample_check(bool failing);

}  // namespace drape::test
