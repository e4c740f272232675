#pragma once

#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// Pairs of triangles that share an edge, to count those that fold over when steps are solved too loosely.
class FlippedPairs {
 public:
  explicit FlippedPairs(const std::vector<Triangle>& triangles);

  /// Returns the number of neighbours whose normals are more than 150° apart, folded back onto each other. Triangles
  /// without an area do not count.
  [[nodiscard]] int count(const Vertices& x) const;

 private:
  std::vector<Triangle> triangles_;
  std::vector<std::array<int, 2>> neighbours_;  // triangles, by shared edge
};

}  // namespace drape
