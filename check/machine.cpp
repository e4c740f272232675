#include "check/machine.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/build_info.hpp"
#include "core/machine.hpp"
#include "sim/kernels/kernels.hpp"

namespace drape {

Machine this_machine(std::string renderer) {
  const BuildInfo& build = build_info();
  const MachineFacts facts = machine_facts();
  return {.drape = build.version,
          .compiler = build.compiler,
          .system = facts.system,
          .processor = facts.processor,
          .cpu_flags = fmt::format("{}", fmt::join(facts.flags, " ")),
          .kernels = std::string(kernels().name),
          .renderer = std::move(renderer)};
}

nlohmann::ordered_json to_json(const Machine& machine) {
  return {{"drape", machine.drape},         {"compiler", machine.compiler},   {"system", machine.system},
          {"processor", machine.processor}, {"cpu_flags", machine.cpu_flags}, {"kernels", machine.kernels},
          {"renderer", machine.renderer}};
}

std::string utc_now() {
  const auto now = std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

}  // namespace drape
