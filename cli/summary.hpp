#pragma once

#include <string>
#include <vector>

#include "run/run_scene.hpp"

namespace drape {

/// Describes a simulation before its start, in one line.
std::string describe(const Scene& scene, const RunOptions& options);

/// Describes the share of each effect in the steps' time, in one line.
std::string effect_shares(const Statistics& statistics);

/// Describes how far an interrupted run came and its partial files: "after 36 of 417 steps; out/5.gif has …".
/// @param resume command that resumes its motion file, if there is one
std::string describe_end(const RunResult& result, const std::string& resume = {});

/// Returns the reasons to distrust the result of a run, a sentence each.
std::vector<std::string> warnings(const RunResult& result);

/// Lists the files of each output with their sizes, a line each.
std::string describe_files(const std::vector<std::vector<OutputFile>>& outputs);

/// Summarises a run in a few lines without a final line end.
std::string summarize(const RunResult& result);

}  // namespace drape
