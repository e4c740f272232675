#include "check/machine.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <sstream>
#include <string_view>

#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

/// Extensions that decide how floating-point code is compiled or dispatched.
constexpr std::array<std::string_view, 14> telling_flags{"sse2",    "sse3",     "ssse3",    "sse4_1",  "sse4_2",
                                                         "avx",     "f16c",     "fma",      "avx2",    "bmi2",
                                                         "avx512f", "avx512bw", "avx512dq", "avx512vl"};

/// The value of the first line "name : value" of /proc/cpuinfo.
std::string cpu_info(std::string_view name) {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(name)) continue;
    const std::size_t colon = line.find(':');
    return colon == std::string::npos ? "" : line.substr(std::min(colon + 2, line.size()));
  }
  return {};
}

std::string cpu_flags() {
  std::istringstream words(cpu_info("flags"));
  std::string text;
  for (std::string word; words >> word;) {
    if (std::find(telling_flags.begin(), telling_flags.end(), word) == telling_flags.end()) continue;
    text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

}  // namespace

Machine this_machine(std::string renderer) {
  Machine machine;
  machine.drape = DRAPE_VERSION;
  machine.compiler = fmt::format("GNU {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
  utsname names{};
  if (uname(&names) == 0) machine.system = fmt::format("{} {} {}", names.sysname, names.release, names.machine);
  machine.processor = cpu_info("model name");
  machine.cpu_flags = cpu_flags();
  machine.kernels = kernels().name;
  machine.renderer = std::move(renderer);
  return machine;
}

std::string utc_now() {
  const auto now = std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

}  // namespace drape
