#include "sim/bending/hinges.hpp"

#include <algorithm>
#include <tuple>

namespace drape {

std::vector<EdgeSide> edge_sides(const std::vector<Triangle>& triangles) {
  std::vector<EdgeSide> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (a == b || b == c || c == a) continue;
    const auto number = static_cast<int>(t);
    sides.push_back({{std::min(a, b), std::max(a, b)}, number, c});
    sides.push_back({{std::min(b, c), std::max(b, c)}, number, a});
    sides.push_back({{std::min(c, a), std::max(c, a)}, number, b});
  }
  std::sort(sides.begin(), sides.end(), [](const EdgeSide& a, const EdgeSide& b) {
    return std::tie(a.edge, a.triangle) < std::tie(b.edge, b.triangle);
  });
  return sides;
}

std::vector<Spring> cross_springs(const Cloth& cloth, double stiffness) {
  std::vector<Edge> pairs;
  for_neighbours(edge_sides(cloth.triangles), [&](const EdgeSide& side, const EdgeSide& next) {
    pairs.push_back({std::min(side.opposite, next.opposite), std::max(side.opposite, next.opposite)});
  });
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  const std::vector<Edge> edges = unique_edges(cloth.triangles);
  std::vector<Spring> springs;
  for (const auto& [i, j] : pairs) {
    if (std::binary_search(edges.begin(), edges.end(), Edge{i, j})) continue;
    springs.push_back(
        {.i = i, .j = j, .rest_length = (cloth.rest.row(i) - cloth.rest.row(j)).norm(), .stiffness = stiffness});
  }
  return springs;
}

}  // namespace drape
