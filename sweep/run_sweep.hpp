#pragma once

#include <filesystem>
#include <map>
#include <stop_token>

#include "run/progress.hpp"
#include "run/shard.hpp"
#include "sweep/plan.hpp"
#include "sweep/run_folder.hpp"

namespace drape {

/// Options for running a sweep.
struct SweepOptions {
  std::filesystem::path folder;  ///< parent of runs/, see run_place()
  std::size_t jobs = 1;          ///< parallel runs
  int threads = 1;               ///< threads per run, for steps of a large cloth
  bool resume = false;           ///< skip settled runs
  Shard shard;                   ///< the runs to do
};

/// A lock on a sweep's folder against other processes. Released by the destructor or the end of the process.
class SweepLock {
 public:
  /// @throws UsageError  if another process holds it
  /// @throws OutputError if the lock file cannot be written
  explicit SweepLock(const std::filesystem::path& folder);
  ~SweepLock();
  SweepLock(const SweepLock&) = delete;
  SweepLock& operator=(const SweepLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// Runs the plan's runs in the shard, each into a folder of its own. A failed run does not stop the others. A stop
/// discards the runs in progress.
/// @returns records of runs whose folder could not be written, by index in the plan
std::map<std::size_t, RunRecord> run_sweep(const SweepPlan& plan, const SweepOptions& options,
                                           const std::stop_token& stop, Progress& progress);

}  // namespace drape
