#pragma once

#include <string>

namespace drape {

/// What this process may take in all: the machine's physical memory, or less where its address space is limited
/// (RLIMIT_AS) [bytes].
double memory_limit();

/// Refuses what cannot fit before it is begun, so that it fails with a figure and not after minutes of swapping.
/// @param what  the subject of the message: "a sparse factor of 1000000 rows"
/// @param bytes what it will take beside what the process holds already
/// @throws UsageError with the figures if that is more than memory_limit()
void require_memory(const std::string& what, double bytes);

}  // namespace drape
