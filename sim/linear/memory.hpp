#pragma once

#include <string>

namespace drape {

/// Refuses what cannot fit, before it is taken.
/// @param what  to name in the message, "the factor of Newton's matrix"
/// @param bytes that it will take
/// @throws UsageError with both figures if that is more than the machine's physical memory
void require_memory(const std::string& what, double bytes);

}  // namespace drape
