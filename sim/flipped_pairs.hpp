#pragma once

#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// Pairs of triangles that share an edge: what folds over when a step is solved too loosely.
class FlippedPairs {
 public:
  explicit FlippedPairs(const std::vector<Triangle>& triangles);

  /// How many neighbouring triangles have normals more than 150° apart: folded back onto each other. Triangles without
  /// an area count as not flipped.
  [[nodiscard]] int count(const Vertices& x) const;

 private:
  std::vector<Triangle> triangles_;
  std::vector<std::array<int, 2>> neighbours_;  // triangles, by shared edge
};

}  // namespace drape
