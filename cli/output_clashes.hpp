#pragma once

#include <vector>

#include "run/run_scene.hpp"

namespace drape {

/// Refuses what would write one file twice, or over a file that is read: by the file, not by how its name is written.
/// @param options of each of the scenes
/// @throws UsageError that lists all such files
void require_files_of_their_own(const std::vector<Scene>& scenes, const std::vector<RunOptions>& options);

}  // namespace drape
