#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "sim/collision/distance.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// Some triangles with their vertices and edges, each once.
struct FeatureSet {
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
  std::vector<int> vertices;

  /// Leaves nothing but memory.
  void clear() {
    triangles.clear();
    edges.clear();
    vertices.clear();
  }
  /// Makes of the triangles, which may be in it more than once, what else it has.
  void complete();
};

/// Whether check(feature, vertices) is true of all pairs of a vertex and a triangle, or of two edges, of one set and
/// the other that share no vertex. Two sets are the same where they are one object.
template <class Check>
bool all_pairs(const FeatureSet& a, const FeatureSet& b, Check&& check) {
  const auto of_vertices = [&](const FeatureSet& first, const FeatureSet& second) {
    return std::ranges::all_of(first.vertices, [&](int i) {
      return std::ranges::all_of(second.triangles, [&](const Triangle& t) {
        return i == t[0] || i == t[1] || i == t[2] ||
               check(Feature::vertex_triangle, std::array<int, 4>{i, t[0], t[1], t[2]});
      });
    });
  };
  if (!of_vertices(a, b) || (&a != &b && !of_vertices(b, a))) return false;
  return std::ranges::all_of(a.edges, [&](const Edge& e) {
    return std::ranges::all_of(b.edges, [&](const Edge& f) {
      return (&a == &b && f >= e) || e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1] ||
             check(Feature::edge_edge, std::array<int, 4>{e[0], e[1], f[0], f[1]});
    });
  });
}

}  // namespace drape
