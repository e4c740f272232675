#include "core/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "core/control_groups.hpp"
#include "core/error.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

/// Memory of this process [bytes]; 0 if the system does not report it.
struct Held {
  double mapped = 0, resident = 0;
};

Held held(const fs::path& root, double page_size) {
  Held pages;
  std::ifstream(root / "proc/self/statm") >> pages.mapped >> pages.resident;
  return {.mapped = pages.mapped * page_size, .resident = pages.resident * page_size};
}

std::optional<double> number_in(const fs::path& file) {
  double number = 0;
  return std::ifstream(file) >> number ? std::optional(number) : std::nullopt;  // "max" is no number: unlimited
}

/// Names of the files of one version of control groups.
struct GroupFiles {
  const char *limit, *usage, *inactive, *active;
};
constexpr GroupFiles version_1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file",
                               "total_active_file"};
constexpr GroupFiles version_2{"memory.max", "memory.current", "inactive_file", "active_file"};

/// Returns a group's file cache, which the kernel reclaims before it kills a process [bytes].
double reclaimable(const fs::path& group, const GroupFiles& files) {
  double sum = 0;
  std::ifstream stream(group / "memory.stat");
  std::string name;
  for (double bytes = 0; stream >> name >> bytes;) {
    if (name == files.inactive || name == files.active) sum += bytes;
  }
  return sum;
}

/// Returns the memory that the control groups still grant this process [bytes].
double left_in_groups(const fs::path& root) {
  double least = std::numeric_limits<double>::infinity();
  for (const ControlGroup& group : control_groups("memory", root)) {
    const GroupFiles& files = group.version == 1 ? version_1 : version_2;
    const std::optional<double> limit = number_in(group.folder / files.limit),
                                usage = number_in(group.folder / files.usage);
    if (limit && usage) least = std::min(least, *limit - std::max(0.0, *usage - reclaimable(group.folder, files)));
  }
  return least;
}

}  // namespace

double memory_left(const fs::path& root) {
  const auto page_size = static_cast<double>(sysconf(_SC_PAGESIZE));
  const Held taken = held(root, page_size);
  double left = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * page_size - taken.resident;
  left = std::min(left, left_in_groups(root));
  return std::max(0.0, std::min(left, address_space_left(root)));
}

double address_space_left(const fs::path& root) {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
    return std::numeric_limits<double>::infinity();
  }
  return static_cast<double>(limit.rlim_cur) - held(root, static_cast<double>(sysconf(_SC_PAGESIZE))).mapped;
}

void require_memory(const std::string& what, double bytes, const std::string& remedy) {
  const double left = memory_left();
  if (bytes <= left) return;
  throw UsageError(fmt::format("{} would take {:.2f} GB of memory, but {:.2f} GB are left: {}", what, bytes / 1e9,
                               left / 1e9, remedy));
}

}  // namespace drape
