#pragma once

#include <string>
#include <vector>

#include "study/study_motion.hpp"

namespace drape {

/// The cloth of the stability maps by semi-implicit Euler, with 0.95 and with 1.2 times the safe step, for as many
/// steps at most: the second motion blows up, and ends there.
std::vector<StudyMotion> limit_motions();

/// Says in a sentence what they are.
std::string describe_limit_motions();

}  // namespace drape
