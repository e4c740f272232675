#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace drape::test {

/// How many random cases to try where this is enough: a tenth under a sanitizer, which looks for something else and
/// takes ten times as long.
constexpr int tries(int enough) {
#ifdef DRAPE_SANITIZED
  return enough / 10;
#else
  return enough;
#endif
}

/// A small generator whose numbers are the same everywhere: Lehmer's, with Park and Miller's constants.
class Random {
 public:
  explicit Random(std::uint64_t seed = 12345) : seed_(seed) {}

  /// Uniform in [0, 1).
  double number() {
    seed_ = seed_ * 48271 % 2147483647;
    return static_cast<double>(seed_) / 2147483647.0;
  }
  /// Uniform in [low, high).
  double between(double low, double high) { return low + (high - low) * number(); }
  /// Uniform in 0 … n−1.
  int below(int n) { return static_cast<int>(number() * n); }

 private:
  std::uint64_t seed_;
};

/// Uniform in [−1, 1)³.
inline Eigen::Vector3d random_point(Random& random) {
  return {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
}

}  // namespace drape::test
