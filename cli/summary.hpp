#pragma once

#include <string>
#include <vector>

#include "run/run_scene.hpp"

namespace drape {

/// One line that says what is about to be simulated.
std::string describe(const Scene& scene, const RunOptions& options);

/// One line with the part of the steps' time that each effect took.
std::string effect_shares(const Statistics& statistics);

/// How far a run came that ended early, and which files have what there is of it: "after 36 of 417 steps; out/5.gif has
/// …".
/// @param resume the command that goes on with its motion file, if there is one
std::string describe_end(const RunResult& result, const std::string& resume = {});

/// Why the result of a run should not be trusted, a sentence for each reason.
std::vector<std::string> doubts(const RunResult& result);

/// The files of each output with their sizes, a line each.
std::string describe_files(const std::vector<std::vector<OutputFile>>& outputs);

/// What a run did, in a few lines without a final line end.
std::string summarize(const RunResult& result);

}  // namespace drape
