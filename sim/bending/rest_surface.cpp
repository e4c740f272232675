#include "sim/bending/rest_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sim/bending/hinges.hpp"

namespace drape {
namespace {

// Least ratio of a triangle's area to its longest edge's square; below, it counts as having no area.
constexpr double least_area = 1e-9;

using Plane = Eigen::Vector2d;
using Point = Eigen::Vector3d;

bool has_area(const Triangle& t, const Vertices& x) {
  const Point a = x.row(t[0]), b = x.row(t[1]), c = x.row(t[2]);
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).norm() > least_area * longest;
}

std::size_t corner_of(const Triangle& t, int vertex) {
  return static_cast<std::size_t>(std::find(t.begin(), t.end(), vertex) - t.begin());
}

}  // namespace

RestSurface::RestSurface(const Cloth& cloth) : cloth_(cloth), beyond_(3 * cloth.triangles.size()) {
  std::vector<bool> pinned(static_cast<std::size_t>(cloth.vertex_count()), false);
  for (const int pin : cloth.pins) pinned[static_cast<std::size_t>(pin)] = true;
  for (const Triangle& t : cloth.triangles) {
    held_.push_back(std::ranges::all_of(t, [&](int vertex) { return pinned[static_cast<std::size_t>(vertex)]; }));
  }
  for_neighbours(edge_sides(cloth.triangles), [&](const EdgeSide& side, const EdgeSide& next) {
    const Triangle& t = triangle(side.triangle);
    if (!has_area(t, cloth.rest) || !has_area(triangle(next.triangle), cloth.rest)) return;
    const std::size_t apex = corner_of(t, side.opposite);
    beyond_[3 * static_cast<std::size_t>(side.triangle) + (apex + 1) % 3] = {next.triangle, next.opposite};
  });
}

bool RestSurface::bends(int t) const {
  return !held(t) && (beyond(t, 0).triangle >= 0 || beyond(t, 1).triangle >= 0 || beyond(t, 2).triangle >= 0);
}

PlacedTriangle RestSurface::lay_out(int t) const {
  const auto& [a, b, c] = triangle(t);
  const Point along = place(b) - place(a), up = place(c) - place(a);
  const double length = along.norm();
  return {t, {Plane(0, 0), Plane(length, 0), Plane(up.dot(along), along.cross(up).norm()) / length}};
}

PlacedTriangle RestSurface::unfold(const PlacedTriangle& from, int side) const {
  const auto p = static_cast<std::size_t>(side), q = (p + 1) % 3;
  const Triangle& t = triangle(from.triangle);
  const auto [next, opposite] = beyond(from.triangle, side);
  const Point edge = place(t[q]) - place(t[p]), up = place(opposite) - place(t[p]);
  const double length = edge.norm();
  const Plane along = (from.corners[q] - from.corners[p]).normalized();
  PlacedTriangle placed{.triangle = next, .corners = {}};
  placed.corners[corner_of(triangle(next), t[p])] = from.corners[p];
  placed.corners[corner_of(triangle(next), t[q])] = from.corners[q];
  placed.corners[corner_of(triangle(next), opposite)] =
      from.corners[p] + up.dot(edge) / length * along + edge.cross(up).norm() / length * outward(from, side);
  return placed;
}

Eigen::Vector2d outward(const PlacedTriangle& t, int side) {
  const auto p = static_cast<std::size_t>(side), q = (p + 1) % 3, apex = (p + 2) % 3;
  const Plane along = (t.corners[q] - t.corners[p]).normalized(), normal(along.y(), -along.x());
  return normal.dot(t.corners[apex] - t.corners[p]) < 0 ? normal : -normal;
}

}  // namespace drape
