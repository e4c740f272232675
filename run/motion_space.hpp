#pragma once

#include <string>

#include "run/run_scene.hpp"

namespace drape {

/// The disk space that a run's motion file will need, and the free space [bytes].
struct MotionSpace {
  double expected = 0, most = 0;  ///< additional to the existing file of a resumed run
  double free = 0;

  /// Returns a sentence with these figures.
  [[nodiscard]] std::string text(const std::string& file) const;
};

MotionSpace motion_space(const Scene& scene, const RunOptions& options);

/// Checks that a motion file can be written.
/// @param begun true if the run resumes this file
/// @throws UsageError  if another run left a file of this name, or the disk is expected to be too small
/// @throws OutputError if the file cannot be written
void require_motion_file(const MotionOptions& options, const MotionSpace& space, bool begun);

}  // namespace drape
