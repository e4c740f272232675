#include "core/processors.hpp"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>

#include "core/control_groups.hpp"

namespace drape {
namespace {

/// Returns the number of processors whose time a group may use; 0 without a limit.
double share_of(const ControlGroup& group) {
  double quota = 0, period = 0;
  if (group.version == 2) {
    std::ifstream(group.folder / "cpu.max") >> quota >> period;  // "max 100000": no limit
  } else {
    std::ifstream(group.folder / "cpu.cfs_quota_us") >> quota;  // -1: no limit
    std::ifstream(group.folder / "cpu.cfs_period_us") >> period;
  }
  return quota > 0 && period > 0 ? quota / period : 0;
}

}  // namespace

int processors_left(const std::filesystem::path& root) {
  cpu_set_t allowed;
  int left = sched_getaffinity(0, sizeof allowed, &allowed) == 0
                 ? CPU_COUNT(&allowed)
                 : static_cast<int>(
                       std::thread::hardware_concurrency());  // the machine has more processors than the set can hold
  for (const ControlGroup& group : control_groups("cpu", root)) {
    const double share = share_of(group);
    if (share > 0 && share < left) left = static_cast<int>(std::ceil(share));
  }
  return std::max(1, left);
}

}  // namespace drape
