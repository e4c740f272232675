#include "sim/linear/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include <fmt/format.h>

#include "core/error.hpp"

namespace drape {
namespace {

double page_size() { return static_cast<double>(sysconf(_SC_PAGESIZE)); }

/// What this process holds already [bytes]; 0 where the system does not say.
double resident() {
  double total = 0, pages = 0;
  std::ifstream("/proc/self/statm") >> total >> pages;
  return pages * page_size();
}

}  // namespace

double memory_limit() {
  double limit = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * page_size();
  rlimit address_space{};
  if (getrlimit(RLIMIT_AS, &address_space) == 0 && address_space.rlim_cur != RLIM_INFINITY) {
    limit = std::min(limit, static_cast<double>(address_space.rlim_cur));
  }
  return limit;
}

void require_memory(const std::string& what, double bytes) {
  const double limit = memory_limit(), taken = resident();
  if (taken + bytes <= limit) return;
  throw UsageError(
      fmt::format("{} would take {:.1f} GB of memory beside the {:.1f} GB in use, and there are {:.1f} GB: take a coarser "
                  "cloth or another method",
                  what, bytes / 1e9, taken / 1e9, limit / 1e9));
}

}  // namespace drape
