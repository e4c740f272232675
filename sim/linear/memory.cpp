#include "sim/linear/memory.hpp"

#include <unistd.h>

#include <fmt/format.h>

#include "core/error.hpp"

namespace drape {

void require_memory(const std::string& what, double bytes) {
  const double present = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (bytes <= present) return;
  throw UsageError(
      fmt::format("{} would take {:.1f} GB of memory, and this machine has {:.1f} GB: take a coarser cloth or "
                  "another method",
                  what, bytes / 1e9, present / 1e9));
}

}  // namespace drape
