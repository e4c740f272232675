#pragma once

#include <string>
#include <vector>

#include "motion/reader.hpp"
#include "run/records.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Writes the records of a complete motion from its file, without simulating it again. A motion file has no step times:
/// they are empty in the trace and null in the statistics.
/// @param scene of the motion
/// @returns the names of the files written
/// @throws UsageError  if the motion is damaged
/// @throws OutputError if a record cannot be written
std::vector<std::string> write_records(MotionReader& motion, const Scene& scene, const RecordPaths& paths);

}  // namespace drape
