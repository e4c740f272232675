#pragma once

#include <vector>

#include "drape/sim/cloth.hpp"
#include "sim/collision/candidates.hpp"

namespace drape {

/// Distances along the cloth across its seams, from vertices near these.
class SeamDistances {
 public:
  /// @param most longest distance that counts [m]
  SeamDistances(const Cloth& cloth, double most);

  /// Returns the distance of two features across a seam: the sum of their distances from its two sides in the rest
  /// shape. Zero if both are on the seam, infinite if it exceeds the longest [m].
  [[nodiscard]] double across(const FeaturePair& pair) const;

 private:
  /// A side of a seam near a vertex.
  struct Near {
    std::size_t side;  // 2·seam + 0 or 1
    double distance;   // [m]
  };

  std::vector<std::vector<Near>> near_;  // per vertex; empty without seams
};

}  // namespace drape
