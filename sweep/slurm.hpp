#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace drape {

/// A sweep as jobs of Slurm: an array of tasks, each a shard of the runs, and one that merges them when they have
/// ended.
struct SlurmJobs {
  std::string sweep;                 ///< the shell's command of the whole sweep, with its folder
  std::string program;               ///< this drape, as the nodes find it
  std::filesystem::path folder;      ///< of the sweep, which the nodes share
  std::size_t tasks = 1;             ///< of the array
  std::vector<std::string> options;  ///< of sbatch, for both: "--partition=short"
};

/// Writes sweep.sbatch, merge.sbatch and submit.sh, which submits both, into the folder. A task that is run again goes
/// on where it was.
/// @returns submit.sh
/// @throws UsageError if this folder or that of the sweep has a line feed in its name, where sbatch would look for
/// options
/// @throws OutputError
std::filesystem::path write_slurm_jobs(const SlurmJobs& jobs);

}  // namespace drape
