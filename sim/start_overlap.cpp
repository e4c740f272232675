#include "sim/start_overlap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "sim/collision/placed_mesh.hpp"
#include "sim/make_system.hpp"

namespace drape {
namespace {

/// Visitor that records the depth of points inside a shape [m].
struct DepthIn {
  const Vertices& x;
  const std::vector<int>& vertices;
  StartOverlap& overlap;

  void operator()(const SphereShape& sphere) const {
    overlap.kind = "sphere";
    note([&](const Point& p) { return sphere.radius - (p - sphere.center).norm(); });
  }
  void operator()(const GroundShape& ground) const {
    overlap.kind = "ground";
    note([&](const Point& p) { return ground.height - ground.normal.dot(p); });
  }
  void operator()(const MeshShape& shape) const {
    overlap.kind = "body";
    const auto count = static_cast<int>(shape.positions.rows());
    const PlacedMesh mesh(std::make_shared<MeshTopology>(*shape.triangles, count), shape.positions);
    if (!mesh.solid()) return;
    note([&](const Point& p) {
      const auto foot = mesh.find(p, 0);
      return foot ? -foot->distance : 0;
    });
  }

 private:
  template <class Depth>
  void note(const Depth& depth_of) const {
    // Points on the surface, up to rounding, are not inside.
    const double rounding = 1e-12 * std::max(1.0, x.cwiseAbs().maxCoeff());
    for (const int i : vertices) {
      const double depth = depth_of(x.row(i).transpose());
      if (!(depth > rounding)) continue;
      ++overlap.vertices;
      overlap.depth = std::max(overlap.depth, depth);
    }
  }
};

}  // namespace

std::vector<StartOverlap> start_overlaps(const SimulationSettings& settings) {
  std::vector<int> vertices;
  for (int i = 0; i < settings.cloth.vertex_count(); ++i) {
    if (!std::ranges::binary_search(settings.cloth.pins, i)) vertices.push_back(i);
  }
  const std::vector<Collider> colliders = make_system(settings).colliders_at(0);
  std::vector<StartOverlap> overlaps;
  for (std::size_t k = 0; k < colliders.size(); ++k) {
    StartOverlap overlap{.collider = k, .kind = {}};
    std::visit(DepthIn{settings.cloth.positions, vertices, overlap}, colliders[k]);
    if (overlap.vertices > 0) overlaps.push_back(overlap);
  }
  return overlaps;
}

std::string describe(const StartOverlap& overlap) {
  return fmt::format(
      "{} of the cloth start{} inside the {} (obstacle {} of the scene), up to {:.3g} m deep: it is "
      "thrown out of there",
      overlap.vertices == 1 ? "1 vertex" : fmt::format("{} vertices", overlap.vertices),
      overlap.vertices == 1 ? "s" : "", overlap.kind, overlap.collider + 1, overlap.depth);
}

}  // namespace drape
