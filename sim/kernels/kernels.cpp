#include "sim/kernels/kernels.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "drape/core/error.hpp"
#include "drape/sim/settings.hpp"

namespace drape {

#if defined(__x86_64__)
extern const Kernels kernels_sse2;
extern const Kernels kernels_avx2;
extern const Kernels kernels_avx512;
#elif defined(__aarch64__)
extern const Kernels kernels_neon;
#else
extern const Kernels kernels_generic;
#endif

std::span<const Kernels* const> all_kernels() {
#if defined(__x86_64__)
  static const std::array<const Kernels*, 3> versions{&kernels_sse2, &kernels_avx2, &kernels_avx512};
#elif defined(__aarch64__)
  static const std::array<const Kernels*, 1> versions{&kernels_neon};
#else
  static const std::array<const Kernels*, 1> versions{&kernels_generic};
#endif
  return versions;
}

namespace {

/// Returns the fastest version that this processor can run.
/// @param most versions to choose from, slowest first
const Kernels* fastest(std::span<const Kernels* const> most) {
  const Kernels* best = most.front();
  for (const Kernels* version : most) {
    if (version->supported() != 0) best = version;
  }
  return best;
}

const Kernels*& current() {
  static const Kernels* chosen = fastest(all_kernels());
  return chosen;
}

}  // namespace

const Kernels& kernels() { return *current(); }

const Kernels& replace_kernels(const Kernels& others) { return *std::exchange(current(), &others); }

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const Kernels* version : all_kernels()) names.emplace_back(version->name);
  return names;
}

std::string instruction_set() { return std::string(kernels().name); }

void limit_instruction_set(std::string_view name) {
  const auto all = all_kernels();
  const auto found = std::ranges::find(all, name, &Kernels::name);
  if (found == all.end()) {
    std::string names;
    for (const Kernels* version : all) names += (names.empty() ? "" : ", ") + std::string(version->name);
    throw UsageError("the instruction set is '" + std::string(name) + "', expected one of " + names);
  }
  current() = fastest(all.first(static_cast<std::size_t>(found - all.begin()) + 1));
}

}  // namespace drape
