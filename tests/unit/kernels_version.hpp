#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <vector>

#include "sim/kernels/kernels.hpp"
#include "tests/support/random.hpp"

namespace drape {
// Lets a failing test print the version's name.
inline void PrintTo(const Kernels* version, std::ostream* out) { *out << version->name; }
}  // namespace drape

namespace drape::test {

inline constexpr int counts[] = {0, 1, 2, 3, 4, 5, 7, 8, 9, 11, 15, 16, 17, 23, 31, 64, 100, 255, 256};

inline std::vector<double> numbers(std::size_t count, int seed) {
  Random random(static_cast<std::uint64_t>(seed));
  std::vector<double> result(count);
  for (double& number : result) number = random.between(-1, 1);
  return result;
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}
inline bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

/// A test of every version of the kernels against the version that runs everywhere.
class KernelsVersion : public testing::TestWithParam<const Kernels*> {
 protected:
  void SetUp() override {
    if (GetParam()->supported() == 0) GTEST_SKIP() << "this processor has no " << GetParam()->name;
  }
  const Kernels& reference = *all_kernels().front();
  const Kernels& tested = *GetParam();
};

}  // namespace drape::test
