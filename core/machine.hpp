#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace drape {

/// The machine that runs this process.
struct MachineFacts {
  std::string processor;           ///< name of the model
  std::vector<std::string> flags;  ///< relevant instruction sets, as in /proc/cpuinfo: "avx2", "fma"
  int threads = 0;                 ///< hardware threads
  std::uint64_t memory = 0;        ///< [bytes]
  std::string system;              ///< "Debian GNU/Linux 12 (bookworm), Linux 6.1.0"
};

/// Returns the facts about this machine; unknown ones are empty.
MachineFacts machine_facts();

/// Returns the memory that this process may still take [bytes]: the least of
///   the machine's physical memory, less the memory of the process,
///   the rest of its address space, if that is limited (RLIMIT_AS),
///   the rest of its control groups' memory, versions 1 and 2; their file cache counts as free.
/// @param root  folder that holds /proc and /sys
double memory_left(const std::filesystem::path& root = "/");

/// Returns the address space that this process may still map [bytes]; infinite without a limit (RLIMIT_AS, ulimit -v).
double address_space_left(const std::filesystem::path& root = "/");

/// Rejects a task that needs too much memory before it starts, instead of after minutes of swapping.
/// @param what   subject of the message: "a sparse factor of 1000000 rows"
/// @param bytes  memory needed in addition to that in use
/// @param remedy advice, as in "take a coarser cloth"
/// @throws UsageError with the figures if `bytes` exceeds memory_left()
void require_memory(const std::string& what, double bytes, const std::string& remedy);

/// Returns how many threads of this process can run at once, at least one. It counts the processors of its affinity
/// (taskset, a cluster's share), limited by its control groups' processor time (a container's --cpus), rounded up.
/// @param root folder that holds /proc and /sys
int processors_left(const std::filesystem::path& root = "/");

/// A control group of this process, or a group around it.
struct ControlGroup {
  std::filesystem::path folder;  ///< folder of its files; need not exist
  int version;                   ///< 1 or 2; their files have different names
};

/// Returns the groups that limit this process's use of a resource. Inside a container the path of the group may not
/// exist; then the mount point is the container's own group.
/// @param controller "memory" or "cpu"
/// @param root       folder that holds /proc and /sys
std::vector<ControlGroup> control_groups(const std::string& controller, const std::filesystem::path& root);

}  // namespace drape
