#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/files.hpp"
#include "drape/scene/scene.hpp"
#include "motion/blocks.hpp"
#include "motion/encoding.hpp"

namespace drape {

/// Random-access reader of a motion file, fastest in the order of steps. Only a few states are in memory. Errors in the
/// file are UsageErrors that name it.
class MotionReader {
 public:
  /// Opens a complete file.
  explicit MotionReader(const std::filesystem::path& file);
  /// Opens the first `length` bytes of a growing file.
  MotionReader(const std::filesystem::path& file, std::uint64_t length);

  [[nodiscard]] const std::filesystem::path& file() const { return blocks_.file(); }
  [[nodiscard]] std::uint64_t size() const { return blocks_.size(); }
  [[nodiscard]] const MotionHeader& header() const { return header_; }
  /// Returns the content of the k-th file of the scene.
  [[nodiscard]] std::string scene_file(std::size_t k) const;

  /// Returns the number of states; step(i) is the step of the i-th.
  [[nodiscard]] std::size_t states() const { return state_index_.size() / 2; }
  [[nodiscard]] std::int64_t step(std::size_t i) const { return static_cast<std::int64_t>(state_index_[2 * i]); }
  [[nodiscard]] std::int64_t last_step() const { return step(states() - 1); }
  /// Returns the i-th state, exact to the bit; valid until the next call.
  const State& state(std::size_t i);

  /// Returns the number of rows, for steps 0, 1, ….
  [[nodiscard]] std::int64_t rows() const { return row_count_; }
  const StepRow& row(std::int64_t step);

  // Functions for resuming the file:

  /// Reads and verifies every block. @throws UsageError if one is damaged
  void verify();
  /// Returns the codec after the last state.
  const StateCodec& codec();
  [[nodiscard]] const std::vector<std::uint64_t>& state_index() const { return state_index_; }
  [[nodiscard]] const std::vector<std::uint64_t>& rows_index() const { return rows_index_; }

 private:
  void read_index();
  void scan(std::uint64_t begin);
  void check_index();
  /// Returns the payload of the block at an offset. @throws UsageError if its tag differs
  [[nodiscard]] std::string payload(std::uint64_t begin, const char* tag) const;
  /// Calls `work` on a block's payload; errors name the file and the block.
  template <class Work>
  auto understood(const char* tag, std::uint64_t begin, const Work& work) const;

  BlockReader blocks_;
  MotionHeader header_;
  std::vector<std::uint64_t> files_;                     // offsets of the scene files' blocks
  std::uint64_t first_ = 0;                              // offset of the motion
  std::vector<std::uint64_t> state_index_, rows_index_;  // step, offset, step, offset, …
  std::int64_t row_count_ = 0;

  std::optional<StateCodec> codec_;
  std::size_t decoded_ = 0;  // states decoded so far; the next is predicted from them
  State state_;
  std::vector<StepRow> rows_;  // rows of the last block read
};

/// The scene of a motion, unpacked into a temporary folder for the lifetime of this object, e.g. for its texture.
class MotionScene {
 public:
  /// @throws UsageError  if the unpacked scene no longer matches the motion
  /// @throws OutputError if it cannot be written to disk
  explicit MotionScene(const MotionReader& motion);

  /// Returns the scene as it was when the motion was computed.
  [[nodiscard]] const LoadedScene& scene() const { return scene_; }
  /// Loads the scene with overrides, see load_scene().
  /// @param folder folder of textures that the overrides name, besides those in the motion
  [[nodiscard]] LoadedScene load(const std::vector<std::string>& overrides, const std::filesystem::path& folder) const;

 private:
  TemporaryFolder folder_;
  std::filesystem::path file_;
  LoadedScene scene_;
};

/// Checks that two scenes have the same physics.
/// @param name name of the source of `other`
/// @throws UsageError that lists the keys that differ
void require_same_physics(const std::string& motion, const LoadedScene& scene, const LoadedScene& other,
                          const std::string& name);

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
