#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace drape {

/// A sweep as Slurm jobs: an array of tasks, one per shard, and a final job that merges the shards.
struct SlurmJobs {
  std::string sweep;                 ///< shell command of the whole sweep, with its folder
  std::string program;               ///< path of this drape on the nodes
  std::filesystem::path folder;      ///< folder of the sweep, shared by the nodes
  std::size_t tasks = 1;             ///< size of the array
  std::vector<std::string> options;  ///< sbatch options of both jobs: "--partition=short"
};

/// Writes sweep.sbatch, merge.sbatch and submit.sh, which submits both, into the folder. A requeued task resumes.
/// @returns submit.sh
/// @throws UsageError if this folder or the sweep's has a line feed in its name, where sbatch would look for options
/// @throws OutputError
std::filesystem::path write_slurm_jobs(const SlurmJobs& jobs);

}  // namespace drape
