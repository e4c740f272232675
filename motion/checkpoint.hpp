#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "motion/reader.hpp"

namespace drape {

/// Data to resume a motion whose run ended early.
struct ResumePoint {
  std::shared_ptr<MotionReader> partial;  ///< reader of the valid part of the growing file
  std::uint64_t length = 0;               ///< length of that part [bytes]
  Simulation::Checkpoint checkpoint;
  std::vector<StepRow> rows;        ///< rows of the last steps before the checkpoint, in no block yet
  std::vector<float> microseconds;  ///< computing time of each step [µs]

  /// Returns the row of any step up to the checkpoint.
  [[nodiscard]] const StepRow& row(std::int64_t step) const;
};

/// Reads the checkpoint and the growing file of a run that ended early.
/// @param file name of the complete motion
/// @throws UsageError if there is no checkpoint, or it is damaged
ResumePoint read_resumption(const std::filesystem::path& file);

/// Returns the bytes of a checkpoint file.
/// @param step   h [s]
/// @param length length of the growing file [bytes]
/// @param rows   rows in no block of it yet
std::string pack_checkpoint(const Simulation::Checkpoint& checkpoint, double step, std::uint64_t length,
                            const std::vector<StepRow>& rows, std::span<const float> microseconds);

}  // namespace drape
