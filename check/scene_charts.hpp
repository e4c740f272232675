#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "check/report.hpp"
#include "figures/diagram_files.hpp"

namespace drape {

/// The diagrams of a comparison, as far as it has any: how far the motion is off ("motion") and how much of that the
/// pictures show ("pictures").
std::vector<NamedChart> scene_charts(const SceneResult& scene, const Comparison& comparison);

/// Writes the diagrams of every scene with their points into the scene's folder beside the report, as write_chart()
/// writes them; those of the whole motion are called "end_to_end.motion" and "end_to_end.pictures".
/// @returns what could not be done, as a sentence; empty if all is there
/// @throws OutputError if a file cannot be written
std::string write_diagrams(const CheckReport& report, const std::filesystem::path& folder);

}  // namespace drape
