#pragma once

// Example:
//   drape::limit_instruction_set("avx2");
//   std::printf("%s", drape::instruction_set().c_str());  // "sse2" where the processor has no AVX2

#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// The instruction sets that the hot loops are compiled for, slowest first; some may not run here.
std::vector<std::string> instruction_sets();

/// The one that is used: the fastest that this processor runs, unless it is limited.
std::string instruction_set();

/// Limits every simulation of the process to at most this one: the bits are the same with all. Not while
/// another thread computes.
/// @throws UsageError if there is none of that name
void limit_instruction_set(std::string_view name);

}  // namespace drape
