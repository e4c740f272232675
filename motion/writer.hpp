#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "motion/block_writer.hpp"
#include "motion/header.hpp"
#include "motion/state_codec.hpp"
#include "scene/scene.hpp"

namespace drape {

struct Resumption;

/// "motion.drape.partial": where a motion is as long as it grows; of use only to who goes on with it.
std::filesystem::path growing_name(const std::filesystem::path& file);
/// "motion.drape.checkpoint": from where it can be gone on with.
std::filesystem::path checkpoint_name(const std::filesystem::path& file);

/// Refuses to begin where somebody may want to go on.
/// @throws UsageError if there is a growing file
void require_not_growing(const std::filesystem::path& file);

/// Writes a motion file. What is added is on its way to the disk at once; what a killed process has left is a growing
/// file and its checkpoint, from which the rest of the motion can be computed. The bytes of the complete file depend on
/// the motion alone, and not on where it was interrupted.
class MotionFileWriter {
 public:
  /// Begins a file.
  /// @param header without what can be told from the scene
  /// @throws UsageError  if a growing file of that name is there
  /// @throws OutputError if it cannot be written
  MotionFileWriter(std::filesystem::path file, MotionHeader header, const Scene& scene);
  /// Goes on with one. @throws as above
  MotionFileWriter(std::filesystem::path file, const Resumption& from);

  /// The next step, from 0 on.
  void add(const StepRow& row);
  /// The state in which the step of the last row has ended.
  void add(const State& state);

  /// Makes sure that all up to now can be gone on from.
  /// @param microseconds that each step has taken
  void keep(const Simulation::Checkpoint& checkpoint, std::span<const float> microseconds);

  /// Removes what there is.
  void discard();

  /// Completes the file under its name. @returns its size [bytes]
  std::uint64_t finish();

 private:
  void write_rows();

  std::filesystem::path file_;
  BlockWriter blocks_;
  MotionHeader header_;
  StateCodec codec_;
  std::vector<StepRow> rows_;                            // that are not in a block yet
  std::vector<std::uint64_t> state_index_, rows_index_;  // step, offset, step, offset, …
};

}  // namespace drape
