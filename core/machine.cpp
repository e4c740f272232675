#include "core/machine.hpp"

#include <sys/sysinfo.h>
#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string_view>
#include <thread>

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

}  // namespace drape
