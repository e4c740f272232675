#include "sim/collision/intersection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "sim/collision/spatial_hash.hpp"

namespace drape {
namespace {

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
Box box_of(const Vertex& vertices, const std::vector<Point>& points) {
  const Point& first = points[static_cast<std::size_t>(vertices[0])];
  Box box{first, first};
  for (const int v : vertices) {
    box.low = box.low.cwiseMin(points[static_cast<std::size_t>(v)]);
    box.high = box.high.cwiseMax(points[static_cast<std::size_t>(v)]);
  }
  return box;
}

}  // namespace

std::vector<Intersection> find_intersections(const std::vector<Edge>& edges, const std::vector<Triangle>& triangles,
                                             const std::vector<Point>& points) {
  const auto place = [&](int v) -> const Point& { return points[static_cast<std::size_t>(v)]; };
  std::vector<Box> boxes;
  for (const Triangle& t : triangles) boxes.push_back(box_of(t, points));
  SpatialHash hash;
  hash.build(boxes);
  std::vector<Intersection> found;
  std::vector<std::size_t> passed;
  for (const Edge& edge : edges) {
    const int i = edge[0], j = edge[1];  // clang 14 lets no lambda capture a structured binding
    passed.clear();
    hash.for_overlapping(box_of(edge, points), [&](int k) {
      const auto number = static_cast<std::size_t>(k);
      const auto& [a, b, c] = triangles[number];
      if (i == a || i == b || i == c || j == a || j == b || j == c) return;
      if (passes_through(place(i), place(j), place(a), place(b), place(c))) passed.push_back(number);
    });
    std::ranges::sort(passed);
    for (const std::size_t triangle : passed) found.push_back({edge, triangle});
  }
  return found;
}

}  // namespace drape
