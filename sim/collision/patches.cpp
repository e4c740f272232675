#include "sim/collision/patches.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace drape {

std::vector<Patch> make_patches(const std::vector<Triangle>& triangles, int first, int vertex_count) {
  const std::vector<Edge> edges = unique_edges(triangles);
  std::vector<char> edge_taken(edges.size(), 0), vertex_taken(static_cast<std::size_t>(vertex_count), 0);
  std::vector<Patch> patches;
  patches.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    Patch patch{{first + t[0], first + t[1], first + t[2]}, {}, {}};
    for (std::size_t c = 0; c < 3; ++c) {
      const int p = t[c], q = t[(c + 1) % 3];
      patch.own_vertex[c] = std::exchange(vertex_taken[static_cast<std::size_t>(p)], 1) == 0;
      if (p == q) continue;
      const auto edge = std::ranges::lower_bound(edges, Edge{std::min(p, q), std::max(p, q)}) - edges.begin();
      patch.own_edge[c] = std::exchange(edge_taken[static_cast<std::size_t>(edge)], 1) == 0;
    }
    patches.push_back(patch);
  }
  return patches;
}

Box swept_box(const Patch& patch, const std::vector<Point>& from, const std::vector<Point>& to, double margin) {
  const Point& start = from[static_cast<std::size_t>(patch.corners[0])];
  Box box{start, start};
  for (const int i : patch.corners) {
    const Point &a = from[static_cast<std::size_t>(i)], &b = to[static_cast<std::size_t>(i)];
    box.low = box.low.cwiseMin(a).cwiseMin(b);
    box.high = box.high.cwiseMax(a).cwiseMax(b);
  }
  box.low.array() -= margin;
  box.high.array() += margin;
  return box;
}

}  // namespace drape
