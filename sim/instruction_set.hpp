#pragma once

// Example:
//   drape::limit_instruction_set("avx2");
//   std::printf("%s", drape::instruction_set().c_str());  // "sse2" where the processor has no AVX2

#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// Returns the instruction sets that the hot loops are compiled for, slowest first; some may not run here.
std::vector<std::string> instruction_sets();

/// Returns the one in use: the fastest that this processor supports, within the limit.
std::string instruction_set();

/// Limits every simulation of the process to this instruction set; all give the same bits. Do not call while another
/// thread computes.
/// @throws UsageError if the name is unknown
void limit_instruction_set(std::string_view name);

}  // namespace drape
