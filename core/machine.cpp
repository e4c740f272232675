#include "core/machine.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/sysinfo.h>
#include <sys/utsname.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>
#include <thread>

#include "drape/core/error.hpp"

namespace drape {
namespace {

/// Returns the text after `key` and `separator` in the first line that starts with the key, without surrounding blanks
/// and quotes.
std::string value_in(const char* file, std::string_view key, char separator) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t at = line.find(separator);
    if (at == std::string::npos) continue;
    const std::size_t first = line.find_first_not_of(" \t\"", at + 1);
    return first == std::string::npos ? "" : line.substr(first, line.find_last_not_of(" \t\"") + 1 - first);
  }
  return {};
}

std::vector<std::string> processor_flags() {
  // Flags that decide how floating-point code is compiled or dispatched.
#ifdef __aarch64__
  constexpr const char* key = "Features";
#else
  constexpr const char* key = "flags";
#endif
  constexpr std::array<std::string_view, 19> wanted{
      "sse2",    "sse3",     "ssse3",    "sse4_1",   "sse4_2",      "avx",   "f16c",    "fma", "avx2", "bmi2",
      "avx512f", "avx512bw", "avx512dq", "avx512vl", "avx512_vnni", "asimd", "asimdhp", "sve", "sve2"};
  std::vector<std::string> flags;
  std::istringstream words(value_in("/proc/cpuinfo", key, ':'));
  for (std::string word; words >> word;) {
    if (std::find(wanted.begin(), wanted.end(), word) != wanted.end()) flags.push_back(word);
  }
  return flags;
}

std::string system_name() {
  std::string name = value_in("/etc/os-release", "PRETTY_NAME", '=');
  utsname kernel{};
  if (uname(&kernel) == 0) {
    if (!name.empty()) name += ", ";
    name += std::string(kernel.sysname) + " " + kernel.release + " " + kernel.machine;
  }
  return name;
}

}  // namespace

MachineFacts machine_facts() {
  MachineFacts machine;
  machine.processor = value_in("/proc/cpuinfo", "model name", ':');
  machine.flags = processor_flags();
  machine.threads = static_cast<int>(std::thread::hardware_concurrency());
  struct sysinfo memory {};
  if (sysinfo(&memory) == 0) machine.memory = std::uint64_t{memory.totalram} * memory.mem_unit;
  machine.system = system_name();
  return machine;
}

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

namespace {

namespace fs = std::filesystem;

/// Adds a group below a mount, and all groups around it.
void add_way_up(const fs::path& mount, fs::path group, int version, std::vector<ControlGroup>& groups) {
  for (group = group.relative_path();; group = group.parent_path()) {
    groups.push_back({mount / group, version});
    if (group.empty()) return;
  }
}

}  // namespace

std::vector<ControlGroup> control_groups(const std::string& controller, const fs::path& root) {
  // Lines are "number:controllers:path"; version 2 has no controllers.
  std::vector<ControlGroup> groups;
  std::ifstream stream(root / "proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    std::istringstream fields(line);
    std::string number, controllers, path;
    std::getline(fields, number, ':');
    std::getline(fields, controllers, ':');
    std::getline(fields, path);
    const fs::path mounts = root / "sys/fs/cgroup";
    if (controllers.empty()) {
      // Next to version 1, version 2 may be mounted in a folder of its own.
      for (const fs::path& mount : {mounts, mounts / "unified"}) add_way_up(mount, path, 2, groups);
    } else if (("," + controllers + ",").find("," + controller + ",") != std::string::npos) {
      add_way_up(mounts / controller, path, 1, groups);
    }
  }
  return groups;
}

}  // namespace drape
