#pragma once

#include <string>
#include <vector>

#include "motion/reader.hpp"
#include "run/records.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Writes the records of a complete motion from its file. Nothing is computed again.
/// What a clock said of its steps is in no motion file: times are empty in the trace, and null in the statistics.
/// @param scene of the motion
/// @returns the names of what was written
/// @throws UsageError  if the motion is damaged
/// @throws OutputError if a record cannot be written
std::vector<std::string> write_records(MotionReader& motion, const Scene& scene, const RecordPaths& paths);

}  // namespace drape
