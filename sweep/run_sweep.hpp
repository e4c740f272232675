#pragma once

#include <filesystem>
#include <map>
#include <stop_token>

#include "run/progress.hpp"
#include "run/shard.hpp"
#include "sweep/plan.hpp"
#include "sweep/run_folder.hpp"

namespace drape {

/// How a sweep is run.
struct SweepOptions {
  std::filesystem::path folder;  ///< with runs/, see run_place()
  std::size_t jobs = 1;          ///< runs at once
  int threads = 1;               ///< that share a step of a large cloth in each of them
  bool resume = false;           ///< leave out the runs that are settled
  Shard shard;                   ///< which of the runs
};

/// A folder in which only one process at a time runs a sweep. The lock goes with the object, or with the process.
class SweepLock {
 public:
  /// @throws UsageError  if another process has it
  /// @throws OutputError if it cannot be written
  explicit SweepLock(const std::filesystem::path& folder);
  ~SweepLock();
  SweepLock(const SweepLock&) = delete;
  SweepLock& operator=(const SweepLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// Runs those of a plan's runs that are in the shard, each into a folder of its own. One that fails does not keep the
/// others from being run. A stop loses the runs that are under way.
/// @returns what became of runs whose folder could not be written, by their place in the plan
std::map<std::size_t, RunRecord> run_sweep(const SweepPlan& plan, const SweepOptions& options,
                                           const std::stop_token& stop, Progress& progress);

}  // namespace drape
