#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "drape/scene/scene.hpp"
#include "motion/blocks.hpp"
#include "motion/encoding.hpp"

namespace drape {

struct ResumePoint;

/// Returns the name of a growing motion: "motion.drape.partial", beside a link's target. Only a resumed run can use
/// that file.
std::filesystem::path growing_name(const std::filesystem::path& file);
/// Returns the name of the checkpoint: "motion.drape.checkpoint", beside a link's target.
std::filesystem::path checkpoint_name(const std::filesystem::path& file);

/// Protects a run that may be resumed from being overwritten.
/// @throws UsageError if there is a growing file with a checkpoint
void require_not_growing(const std::filesystem::path& file);

/// Writer of a motion file. Data goes to the disk at once; a killed process leaves a growing file and its checkpoint,
/// from which the rest of the motion can be computed. The bytes of the complete file depend only on the motion, not on
/// interruptions.
class MotionFileWriter {
 public:
  /// Begins a file.
  /// @param header without the fields that follow from the scene
  /// @throws UsageError  if a growing file of that name exists
  /// @throws OutputError if it cannot be written
  MotionFileWriter(std::filesystem::path file, MotionHeader header, const LoadedScene& scene);
  /// Resumes a file. @throws as above
  MotionFileWriter(std::filesystem::path file, const ResumePoint& from);

  /// Adds the row of the next step, from 0 on.
  void add(const StepRow& row);
  /// Adds the state at the end of the last row's step.
  void add(const State& state);

  /// Writes a checkpoint to resume from.
  /// @param microseconds computing time of each step
  void keep(const Simulation::Checkpoint& checkpoint, std::span<const float> microseconds);

  /// Removes the growing file and its checkpoint.
  void discard();

  /// Completes the file under its final name. @returns its size [bytes]
  std::uint64_t finish();

 private:
  void write_rows();

  std::filesystem::path file_;
  BlockWriter blocks_;
  MotionHeader header_;
  StateCodec codec_;
  std::vector<StepRow> rows_;                            // rows in no block yet
  std::vector<std::uint64_t> state_index_, rows_index_;  // step, offset, step, offset, …
};

}  // namespace drape
