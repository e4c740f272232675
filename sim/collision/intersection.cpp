#include "sim/collision/intersection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "sim/collision/spatial_hash.hpp"

namespace drape {
namespace {

using Point = Eigen::Vector3d;

// Relative rounding error of a vertex that was rotated and then translated.
constexpr double place_rounding = 8 * std::numeric_limits<double>::epsilon();

/// Six times the signed volume of four points, with a bound on its rounding error.
struct Volume {
  double value, error;

  /// @param moved error of each point's position
  Volume(const Point& a, const Point& b, const Point& c, const Point& d, double moved) {
    const Point u = b - a, v = c - a, w = d - a;
    value = u.cross(v).dot(w);
    // (7 + 56ε)ε times the sum of the products' sizes (Shewchuk 1997, section 4.3, with ε = 2⁻⁵³), plus the sizes of
    // the derivatives by the positions.
    const Point s = u.cwiseAbs(), t = v.cwiseAbs(), r = w.cwiseAbs();
    const Point uv = sizes(s, t);
    error = 4 * std::numeric_limits<double>::epsilon() * uv.dot(r) + 2 * moved * (uv + sizes(t, r) + sizes(r, s)).sum();
  }

  [[nodiscard]] bool positive() const { return value > error; }
  [[nodiscard]] bool negative() const { return value < -error; }

 private:
  /// Returns sums of the sizes of a cross product's terms.
  static Point sizes(const Point& a, const Point& b) {
    return {a.y() * b.z() + a.z() * b.y(), a.z() * b.x() + a.x() * b.z(), a.x() * b.y() + a.y() * b.x()};
  }
};

/// Returns true if an edge passes through a triangle, its sides and corners included. Configurations that are coplanar
/// up to rounding return false.
bool passes_through(const Point& from, const Point& to, const Point& a, const Point& b, const Point& c) {
  std::array<Point, 5> p{from, to, a, b, c};
  double largest = 0, size = 0;
  for (Point& point : p) {
    largest = std::max(largest, point.cwiseAbs().maxCoeff());
    point -= from;
    size = std::max(size, point.cwiseAbs().maxCoeff());
  }
  for (Point& point : p) point /= size;  // keeps products within the range of a double for cloth of any size
  const double moved = place_rounding * largest / size;
  const Volume first(p[2], p[3], p[4], p[0], moved), second(p[2], p[3], p[4], p[1], moved);
  if (!(first.positive() && second.negative()) && !(first.negative() && second.positive())) return false;

  const Volume ab(p[0], p[1], p[2], p[3], 0), bc(p[0], p[1], p[3], p[4], 0), ca(p[0], p[1], p[4], p[2], 0);
  const bool left = ab.positive() || bc.positive() || ca.positive();
  const bool right = ab.negative() || bc.negative() || ca.negative();
  return !left || !right;
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
    const int i = edge[0], j = edge[1];  // clang 14 does not let lambdas capture structured bindings
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
