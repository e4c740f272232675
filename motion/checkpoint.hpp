#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "motion/reader.hpp"

namespace drape {

/// Where a motion that ended early can be gone on from.
struct Resumption {
  std::shared_ptr<MotionReader> partial;  ///< its growing file, as far as it counts
  std::uint64_t length = 0;               ///< of that
  Simulation::Checkpoint checkpoint;
  std::vector<StepRow> rows;        ///< of the last steps before it, that are in no block yet
  std::vector<float> microseconds;  ///< that each step has taken

  /// The row of any step up to there.
  [[nodiscard]] const StepRow& row(std::int64_t step) const;
};

/// Reads what a run that ended early has left of a motion.
/// @param file its name when it is complete
/// @throws UsageError if there is nothing to go on from, or it is damaged
Resumption read_resumption(const std::filesystem::path& file);

/// The bytes of a checkpoint file.
/// @param step   h [s]
/// @param length of the growing file
/// @param rows   that are not in it yet
std::string pack_checkpoint(const Simulation::Checkpoint& checkpoint, double step, std::uint64_t length,
                            const std::vector<StepRow>& rows, std::span<const float> microseconds);

}  // namespace drape
