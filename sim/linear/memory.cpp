#include "sim/linear/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include <fmt/format.h>

#include "core/error.hpp"

namespace drape {
namespace {

/// What this process holds already [bytes]; 0 where the system does not say.
struct Held {
  double mapped = 0, resident = 0;
};

Held held(double page_size) {
  Held pages;
  std::ifstream("/proc/self/statm") >> pages.mapped >> pages.resident;
  return {.mapped = pages.mapped * page_size, .resident = pages.resident * page_size};
}

}  // namespace

double memory_left() {
  const auto page_size = static_cast<double>(sysconf(_SC_PAGESIZE));
  const Held taken = held(page_size);
  const double physical = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * page_size - taken.resident;
  rlimit address_space{};
  if (getrlimit(RLIMIT_AS, &address_space) != 0 || address_space.rlim_cur == RLIM_INFINITY) return physical;
  return std::max(0.0, std::min(physical, static_cast<double>(address_space.rlim_cur) - taken.mapped));
}

void require_memory(const std::string& what, double bytes) {
  const double left = memory_left();
  if (bytes <= left) return;
  throw UsageError(
      fmt::format("{} would take {:.2f} GB of memory, and {:.2f} GB are left: take a coarser cloth or another method",
                  what, bytes / 1e9, left / 1e9));
}

}  // namespace drape
