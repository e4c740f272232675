#pragma once

#include <filesystem>
#include <string>

namespace drape {

/// What this process may still take [bytes]: the least of what is left of
///   the machine's physical memory, less what the process holds of it,
///   its address space, where that is limited (RLIMIT_AS),
///   the memory of the control groups it is in, versions 1 and 2, less what they can reclaim of it (the file cache).
/// @param root  where /proc and /sys are
double memory_left(const std::filesystem::path& root = "/");

/// What this process may still map, where that is limited (RLIMIT_AS, ulimit -v) [bytes]; infinite where it is not.
double address_space_left(const std::filesystem::path& root = "/");

/// Refuses what cannot fit before it is begun, so that it fails with a figure and not after minutes of swapping.
/// @param what   the subject of the message: "a sparse factor of 1000000 rows"
/// @param bytes  what it will take beside what the process holds already
/// @param remedy what to do about it, as in "take a coarser cloth"
/// @throws UsageError with the figures if that is more than memory_left()
void require_memory(const std::string& what, double bytes, const std::string& remedy);

}  // namespace drape
