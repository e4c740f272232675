#pragma once

#include <string>

#include "study/accuracy.hpp"

namespace drape {

/// Checks that the lists of a scene read from a file have matching sizes, so that a report can be made.
/// @returns the first defect as a sentence without a full stop; empty: none
std::string unsound_in(const SceneAccuracy& scene);

}  // namespace drape
