#pragma once

#include <string>

#include "run/run_scene.hpp"

namespace drape {

/// One line that says what is about to be simulated.
std::string describe(const Scene& scene, const RunOptions& options);

/// One line with the part of the steps' time that each effect took.
std::string effect_shares(const Statistics& statistics);

/// What a run did, in a few lines without a final line end.
std::string summarize(const RunResult& result);

}  // namespace drape
