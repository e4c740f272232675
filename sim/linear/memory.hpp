#pragma once

#include <string>

namespace drape {

/// What this process may still take: the machine's physical memory less what it holds of it, or where its address space
/// is limited (RLIMIT_AS), what is left of that, if this is less [bytes].
double memory_left();

/// Refuses what cannot fit before it is begun, so that it fails with a figure and not after minutes of swapping.
/// @param what  the subject of the message: "a sparse factor of 1000000 rows"
/// @param bytes what it will take beside what the process holds already
/// @throws UsageError with the figures if that is more than memory_left()
void require_memory(const std::string& what, double bytes);

}  // namespace drape
