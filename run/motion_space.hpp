#pragma once

#include <string>

#include "run/run_scene.hpp"

namespace drape {

/// What a run's motion file will need on its disk, and what there is [bytes].
struct MotionSpace {
  double expected = 0, most = 0;  ///< beside what is there already, of a run that goes on
  double free = 0;

  /// A sentence that says so.
  [[nodiscard]] std::string text(const std::string& file) const;
};

MotionSpace motion_space(const Scene& scene, const RunOptions& options);

/// Looks whether a motion file can be written.
/// @param begun where a run goes on with it
/// @throws UsageError  if another run has left one of its name, or it cannot be expected to fit on the disk
/// @throws OutputError if it cannot be written
void require_motion_file(const MotionOptions& options, const MotionSpace& space, bool begun);

}  // namespace drape
