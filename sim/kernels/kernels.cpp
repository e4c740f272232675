#include "sim/kernels/kernels.hpp"

#include <array>
#include <cstdlib>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace drape {

extern const Kernels kernels_sse2;
#ifdef __x86_64__
extern const Kernels kernels_avx2;
extern const Kernels kernels_avx512;
#endif

std::span<const Kernels* const> all_kernels() {
#ifdef __x86_64__
  static const std::array<const Kernels*, 3> versions{&kernels_sse2, &kernels_avx2, &kernels_avx512};
#else
  static const std::array<const Kernels*, 1> versions{&kernels_sse2};
#endif
  return versions;
}

namespace {

const Kernels& choose() {
  const char* cap = std::getenv("DRAPE_ISA");
  if (cap != nullptr && *cap == '\0') cap = nullptr;  // as if it was not set
  const Kernels* best = nullptr;
  std::string names;
  for (const Kernels* version : all_kernels()) {
    if (best == nullptr || version->supported() != 0) best = version;
    if (cap != nullptr && version->name == cap) return *best;
    names += (names.empty() ? "" : ", ") + std::string(version->name);
  }
  if (cap != nullptr) throw UsageError("DRAPE_ISA is '" + std::string(cap) + "', expected one of " + names);
  return *best;
}

const Kernels*& current() {
  static const Kernels* chosen = &choose();
  return chosen;
}

}  // namespace

const Kernels& kernels() { return *current(); }

const Kernels& replace_kernels(const Kernels& others) { return *std::exchange(current(), &others); }

}  // namespace drape
