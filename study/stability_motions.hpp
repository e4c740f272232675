#pragma once

#include <string>
#include <vector>

#include "study/study_motion.hpp"

namespace drape {

/// Returns two motions of the stability maps' cloth by semi-implicit Euler, with 0.95 and 1.2 times the safe step. The
/// second ends early, with its blow-up.
std::vector<StudyMotion> limit_motions();

/// Describes them in a sentence.
std::string describe_limit_motions();

}  // namespace drape
