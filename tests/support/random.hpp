#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace drape::test {

/// Returns the number of random cases to try: a tenth under a sanitizer, which is ten times slower and looks for other
/// defects.
constexpr int tries(int enough) {
#ifdef DRAPE_SANITIZED
  return enough / 10;
#else
  return enough;
#endif
}

/// A small generator of the same numbers on every machine: Lehmer's, with Park and Miller's constants.
class Random {
 public:
  explicit Random(std::uint64_t seed = 12345) : seed_(seed) {}

  /// Returns a uniform number in [0, 1).
  double number() {
    seed_ = seed_ * 48271 % 2147483647;
    return static_cast<double>(seed_) / 2147483647.0;
  }
  /// Returns a uniform number in [low, high).
  double between(double low, double high) { return low + (high - low) * number(); }
  /// Returns a uniform integer in 0 … n−1.
  int below(int n) { return static_cast<int>(number() * n); }

 private:
  std::uint64_t seed_;
};

/// Returns a uniform point in [−1, 1)³.
inline Eigen::Vector3d random_point(Random& random) {
  return {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
}

}  // namespace drape::test
