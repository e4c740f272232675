#pragma once

#include "check/report.hpp"

namespace drape::test {

/// Makes the report of a check of three scenes, with drawn pictures.
/// @param failing true: one scene changed and one had no golden; false: all passed
CheckReport sample_check(bool failing);

}  // namespace drape::test
