#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/collision/distance.hpp"

namespace drape {

/// Two features that share no vertex and may touch in a step.
struct FeaturePair {
  Feature feature;
  std::array<int, 4> vertices;  ///< in the order of FourPoints

  auto operator<=>(const FeaturePair&) const = default;  // NOLINT(modernize-use-nullptr): it takes <=> for a 0
};

/// Returns the four points of a pair.
inline FourPoints gather(const std::vector<Point>& points, const std::array<int, 4>& v) {
  return {points[static_cast<std::size_t>(v[0])], points[static_cast<std::size_t>(v[1])],
          points[static_cast<std::size_t>(v[2])], points[static_cast<std::size_t>(v[3])]};
}

/// Fast rejection of pairs that stay apart while their vertices move on straight paths. It computes in single
/// precision, eight pairs at once, and never rejects a pair that comes within the reach.
///
/// A pair is rejected if a slab separates its features at both ends of the paths; then it does so in between. The
/// vector between the closest points in the middle of the paths is a good axis, but any axis proves the distance, so
/// its error does not matter. The width of the slab has a rounding error. Let u = 2⁻²⁴, and S the size of the largest
/// coordinate, relative to the middle of all points. Rounding moves a coordinate by uS, and the difference of two by
/// another 2uS. A product of axis n and difference d errs by 3u Σ|nᵢ||dᵢ| ≤ 6uS Σ|nᵢ|. Each height on the axis then
/// errs by at most 10uS Σ|nᵢ| ≤ 18uS ‖n‖, and the difference of two by 36uS ‖n‖, with 7uS ‖n‖ for its own rounding:
/// less than 64uS ‖n‖. The squares that are compared have relative errors of at most 8u.
class PairFilter {
 public:
  /// Sets the paths of all vertices.
  void set(const std::vector<Point>& from, const std::vector<Point>& to);

  /// Calls visit(pair) for the pairs that may come within `reach` [m], in their order. All are of one kind.
  template <class Visit>
  void for_near(Feature feature, std::span<const FeaturePair> pairs, double reach, Visit&& visit) const {
    std::array<int, at_once> near;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
    for (; !pairs.empty(); pairs = pairs.subspan(std::min(at_once, pairs.size()))) {
      const int found = find(feature, pairs.first(std::min(at_once, pairs.size())), reach, near);
      for (int n = 0; n < found; ++n) {
        visit(pairs[static_cast<std::size_t>(near[static_cast<std::size_t>(n)])]);
      }
    }
  }

 private:
  static constexpr std::size_t at_once = 256;
  /// Finds the numbers of the near pairs; returns how many there are.
  [[nodiscard]] int find(Feature feature, std::span<const FeaturePair> pairs, double reach,
                         std::array<int, at_once>& near) const;

  std::vector<std::array<float, 8>> rows_;  // x, y, z, 0 at the start and at the end, relative to the middle [m]
  double size_ = 0;                         // largest coordinate [m]
};

}  // namespace drape
