#include "sim/collision/intersection.hpp"

#include <Eigen/Geometry>

#include "sim/collision/spatial_hash.hpp"

namespace drape {
namespace {

using Point = Eigen::Vector3d;

/// Six times the volume that four points span, with the sign of their orientation.
double volume(const Point& a, const Point& b, const Point& c, const Point& d) {
  return (b - a).cross(c - a).dot(d - a);
}

/// Also through a triangle's side or corner.
bool passes_through(const Point& from, const Point& to, const Point& a, const Point& b, const Point& c) {
  if (volume(a, b, c, from) * volume(a, b, c, to) >= 0) return false;
  const double ab = volume(from, to, a, b), bc = volume(from, to, b, c), ca = volume(from, to, c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

template <class Vertex>
Box box_of(const Vertex& vertices, const Vertices& x) {
  Box box{x.row(vertices[0]).transpose(), x.row(vertices[0]).transpose()};
  for (const int v : vertices) {
    box.low = box.low.cwiseMin(x.row(v).transpose());
    box.high = box.high.cwiseMax(x.row(v).transpose());
  }
  return box;
}

}  // namespace

std::optional<std::pair<Edge, Triangle>> find_intersection(const std::vector<Triangle>& triangles, const Vertices& x) {
  const auto place = [&](int v) -> Point { return x.row(v).transpose(); };
  std::vector<Box> boxes;
  for (const Triangle& t : triangles) boxes.push_back(box_of(t, x));
  SpatialHash hash;
  hash.build(boxes);
  for (const Edge& edge : unique_edges(triangles)) {
    const int i = edge[0], j = edge[1];  // clang 14 lets no lambda capture a structured binding
    std::optional<std::size_t> found;
    hash.for_overlapping(box_of(edge, x), [&](int k) {
      const auto number = static_cast<std::size_t>(k);
      const auto& [a, b, c] = triangles[number];
      if (i == a || i == b || i == c || j == a || j == b || j == c) return;
      if (found.value_or(number) < number) return;
      if (passes_through(place(i), place(j), place(a), place(b), place(c))) found = number;
    });
    if (found) return std::pair{edge, triangles[*found]};
  }
  return std::nullopt;
}

}  // namespace drape
