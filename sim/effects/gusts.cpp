#include "sim/effects/gusts.hpp"

#include <array>
#include <cmath>
#include <cstdint>

#include "core/keys.hpp"

namespace drape {
namespace {

constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U;  // 2⁶⁴ divided by the golden ratio

/// Returns a hash of a 64-bit number (the finaliser of SplitMix64, Steele, Lea and Flood 2014).
std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

/// Returns three numbers in [−1, 1), each from 21 bits.
Eigen::Vector3d random_vector(std::uint64_t bits) {
  constexpr std::uint64_t mask = (1U << 21) - 1;
  constexpr double half = 1 << 20;
  return {static_cast<double>(bits & mask) / half - 1, static_cast<double>(bits >> 21 & mask) / half - 1,
          static_cast<double>(bits >> 42 & mask) / half - 1};
}

}  // namespace

void GustValues::describe(Keys& keys) {
  keys.add("gust", &speed, "m/s", "Largest change of each component of the wind by gusts; 0 is a steady wind.")
      .at_least(0);
  keys.add("gust_size", &size, "m", "Distance from one gust to the next.").above(0);
  keys.add("gust_duration", &duration, "s", "Lifetime of a gust, in the frame moving with the wind.").above(0);
  keys.add("seed", &seed, "", "Different numbers give different gusts.");
}

Eigen::Vector3d Gusts::at(const Eigen::Vector3d& place, double time) const {
  const Eigen::Vector3d carried = (place - time * wind_) / values_.size;
  const std::array<double, 4> point{carried[0], carried[1], carried[2], time / values_.duration};
  std::array<double, 4> weight{};
  std::array<std::int64_t, 4> cell{};
  for (std::size_t d = 0; d < 4; ++d) {
    const double below = std::floor(point[d]), s = point[d] - below;
    cell[d] = static_cast<std::int64_t>(below);
    weight[d] = s * s * (3 - 2 * s);
  }
  // Corners of the lattice cell: each dimension splits the previous corners into lower and upper ones.
  std::array<std::uint64_t, 16> bits{mixed(static_cast<std::uint64_t>(values_.seed))};
  std::array<double, 16> share{1};
  for (std::size_t d = 0, corners = 1; d < 4; ++d, corners *= 2) {
    const std::uint64_t lower = static_cast<std::uint64_t>(cell[d]) * odd;
    for (std::size_t k = 0; k < corners; ++k) {
      bits[k + corners] = mixed(bits[k] + lower + odd);
      bits[k] = mixed(bits[k] + lower);
      share[k + corners] = share[k] * weight[d];
      share[k] *= 1 - weight[d];
    }
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < bits.size(); ++k) sum += share[k] * random_vector(bits[k]);
  return values_.speed * sum;
}

}  // namespace drape
