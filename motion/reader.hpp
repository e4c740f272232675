#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "motion/block_reader.hpp"
#include "motion/header.hpp"
#include "motion/state_codec.hpp"

namespace drape {

/// Reads a motion file, in any order but best in that of the steps: of the motion itself, a few states are in memory.
/// What is wrong with the file is a UsageError that names it.
class MotionReader {
 public:
  /// A complete file.
  explicit MotionReader(const std::filesystem::path& file);
  /// The first `length` bytes of one that still grows.
  MotionReader(const std::filesystem::path& file, std::uint64_t length);

  [[nodiscard]] const std::filesystem::path& file() const { return blocks_.file(); }
  [[nodiscard]] std::uint64_t size() const { return blocks_.size(); }
  [[nodiscard]] const MotionHeader& header() const { return header_; }
  /// What was in the k-th of the files that the scene names.
  [[nodiscard]] std::string scene_file(std::size_t k) const;

  /// How many states there are, and of which step the i-th is.
  [[nodiscard]] std::size_t states() const { return state_index_.size() / 2; }
  [[nodiscard]] std::int64_t step(std::size_t i) const { return static_cast<std::int64_t>(state_index_[2 * i]); }
  [[nodiscard]] std::int64_t last_step() const { return step(states() - 1); }
  /// The i-th state, to the bit; holds until the next call.
  const State& state(std::size_t i);

  /// How many rows there are: those of steps 0, 1, …
  [[nodiscard]] std::int64_t rows() const { return row_count_; }
  const StepRow& row(std::int64_t step);

  // For who goes on with the file:

  /// Reads every block to its end. @throws UsageError if one is damaged
  void verify();
  /// As it is after the last state.
  const StateCodec& codec();
  [[nodiscard]] const std::vector<std::uint64_t>& state_index() const { return state_index_; }
  [[nodiscard]] const std::vector<std::uint64_t>& rows_index() const { return rows_index_; }

 private:
  void read_index();
  void scan(std::uint64_t begin);
  void check_index();
  /// The payload of the block at a place, which must have this tag.
  [[nodiscard]] std::string payload(std::uint64_t begin, const char* tag) const;
  /// Does a thing with a block's payload, and names the file and the block if that is wrong.
  template <class Work>
  auto understood(const char* tag, std::uint64_t begin, const Work& work) const;

  BlockReader blocks_;
  MotionHeader header_;
  std::vector<std::uint64_t> files_;                     // where their blocks are
  std::uint64_t first_ = 0;                              // where the motion begins
  std::vector<std::uint64_t> state_index_, rows_index_;  // step, offset, step, offset, …
  std::int64_t row_count_ = 0;

  std::optional<StateCodec> codec_;
  std::size_t decoded_ = 0;  // states of this number were: the next is foretold from them
  State state_;
  std::vector<StepRow> rows_;  // of the last block that was read
};

}  // namespace drape
