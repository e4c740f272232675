#include "compare/vertex_matches.hpp"

namespace drape {
namespace {

constexpr double same_place = 1e-3;  // tolerance, in mean edge lengths

VertexMatch match(const Cloth& cloth, const Cloth& first) {
  VertexMatch found;
  found.comparable = cloth.vertex_count() == first.vertex_count();
  if (!found.comparable || cloth.triangles == first.triangles) return found;
  const double tolerance = same_place * mean_edge(first.positions, first.triangles);
  if ((cloth.positions - first.positions).rowwise().norm().maxCoeff() <= tolerance) return found;
  if (auto order = match_vertices(cloth.positions, first.positions, tolerance)) {
    found.order = std::move(*order);
    found.note = "its vertices are in another order than the first motion's, and are matched by the first frame";
  } else {
    found.note =
        "its triangles are not the first motion's, nor is its first frame: vertices of the same number are compared";
  }
  return found;
}

}  // namespace

std::vector<VertexMatch> match_scenes(const std::vector<Scene>& scenes) {
  std::vector<VertexMatch> all;
  for (const Scene& scene : scenes) all.push_back(match(scene.simulation.cloth, scenes.front().simulation.cloth));
  return all;
}

}  // namespace drape
