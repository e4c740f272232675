#pragma once

#include <filesystem>
#include <string>

namespace drape {

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
/// @throws UsageError with the figures if that is more than memory_left()
void require_memory(const std::string& what, double bytes, const std::string& remedy);

}  // namespace drape
