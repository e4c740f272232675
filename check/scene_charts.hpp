#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "check/report.hpp"
#include "figures/diagram_files.hpp"

namespace drape {

/// Returns the diagrams of a comparison, if it has data: the deviation of the motion ("motion"), and the differences of
/// the pictures ("pictures").
std::vector<NamedChart> scene_charts(const SceneResult& scene, const Comparison& comparison);

/// Writes the diagrams of every scene with their points into the scene's folder beside the report, see write_chart().
/// Those of the whole motion are called "end_to_end.motion" and "end_to_end.pictures".
/// @returns the first problem as a sentence; empty if everything was written
/// @throws OutputError if a file cannot be written
std::string write_diagrams(const CheckReport& report, const std::filesystem::path& folder);

}  // namespace drape
