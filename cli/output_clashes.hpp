#pragma once

#include <vector>

#include "run/run_scene.hpp"

namespace drape {

/// Checks that no file is written twice, and that no input is overwritten. Files are compared by identity, not by name.
/// @param options of each scene
/// @throws UsageError that lists all such files
void require_distinct_files(const std::vector<Scene>& scenes, const std::vector<RunOptions>& options);

}  // namespace drape
