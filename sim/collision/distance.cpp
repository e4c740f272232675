#include "sim/collision/distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "sim/collision/spatial_index.hpp"

namespace drape {
namespace {

/// Returns the weights with the squared distance. Sums differences of points, which are accurate far from the origin.
Nearest with_distance(const FourPoints& p, const std::array<double, 4>& w) {
  const Point d = w[0] * (p[0] - p[2]) + w[1] * (p[1] - p[2]) + w[3] * (p[3] - p[2]);
  return {d.squaredNorm(), w};
}

/// Returns the parameter, in [0, 1], of a segment's closest point to p.
double place_on_segment(const Point& p, const Point& from, const Point& to) {
  const Point along = to - from;
  const double squared = along.squaredNorm();
  return squared > 0 ? std::clamp((p - from).dot(along) / squared, 0.0, 1.0) : 0.0;
}

Nearest vertex_triangle(const FourPoints& p) {
  const Point ab = p[2] - p[1], ac = p[3] - p[1], normal = ab.cross(ac);
  const double squared = normal.squaredNorm();
  if (squared > 0) {
    const Point to = p[0] - p[1];
    const double b = to.cross(ac).dot(normal) / squared, c = ab.cross(to).dot(normal) / squared;
    if (b >= 0 && c >= 0 && b + c <= 1) return with_distance(p, {1, b + c - 1, -b, -c});
  }
  Nearest best{-1, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t from = 1 + k, to = 1 + (k + 1) % 3;
    const double t = place_on_segment(p[0], p[from], p[to]);
    std::array<double, 4> w{1, 0, 0, 0};
    w[from] -= 1 - t;
    w[to] -= t;
    const Nearest on_edge = with_distance(p, w);
    if (best.squared < 0 || on_edge.squared < best.squared) best = on_edge;
  }
  return best;
}

Nearest edge_edge(const FourPoints& p) {
  const Point first = p[1] - p[0], second = p[3] - p[2], between = p[0] - p[2];
  const double a = first.squaredNorm(), e = second.squaredNorm(), b = first.dot(second), c = first.dot(between);
  const double cross = first.cross(second).squaredNorm();  // a e − b² without cancellation
  const double f = second.dot(between);
  double s = cross > 1e-18 * a * e ? std::clamp((b * f - c * e) / cross, 0.0, 1.0) : 0.0;
  // Project onto the other edge and back, as the solution may be past an end.
  const double t = place_on_segment(p[0] + s * first, p[2], p[3]);
  s = place_on_segment(p[2] + t * second, p[0], p[1]);
  return with_distance(p, {1 - s, s, t - 1, -t});
}

}  // namespace

Nearest nearest(Feature feature, const FourPoints& p) {
  return feature == Feature::vertex_triangle ? vertex_triangle(p) : edge_edge(p);
}

namespace {

// Multiple of the gap at which features count as colliding, as the gap is only approached.
constexpr double near_enough = 1.2;
// Features that touch up to rounding need many steps. Beyond this they count as colliding.
constexpr int max_steps = 200;

Point mean(const FourPoints& p) { return (p[0] + p[1] + p[2] + p[3]) / 4; }

/// Returns an upper bound on the change of two features' distance when their points move by `move` [m]. The mean motion
/// of all four does not count.
double largest_change(Feature feature, const FourPoints& move) {
  const Point together = mean(move);
  const double a = (move[0] - together).norm(), b = (move[1] - together).norm();
  const double c = (move[2] - together).norm(), d = (move[3] - together).norm();
  return feature == Feature::vertex_triangle ? a + std::max({b, c, d}) : std::max(a, b) + std::max(c, d);
}

}  // namespace

std::optional<double> time_of_impact(Feature feature, FourPoints p, FourPoints move, double widest) {
  const double speed = largest_change(feature, move);
  double distance = std::sqrt(nearest(feature, p).squared);
  const double gap = std::min(kept_gap * distance, widest);
  if (!(distance > 0) || speed <= distance - gap) return std::nullopt;
  const Point together = mean(move);
  for (Point& m : move) m -= together;
  double time = 0;
  for (int step = 0; step < max_steps; ++step) {
    const double forward = (distance - gap) / speed;
    if (time + forward > 1) return std::nullopt;
    time += forward;
    for (std::size_t i = 0; i < 4; ++i) p[i] += forward * move[i];
    const Nearest now = nearest(feature, p);
    distance = std::sqrt(now.squared);
    if (distance <= near_enough * gap) return time;
    // Features that slide along each other come no nearer on the rest of their path.
    FourPoints to = p;
    for (std::size_t i = 0; i < 4; ++i) to[i] += (1 - time) * move[i];
    if (kept_apart(feature, now.difference(p), p, to, near_enough * gap)) return std::nullopt;
  }
  return time;
}

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

}  // namespace

std::vector<Intersection> find_intersections(const std::vector<Edge>& edges, const std::vector<Triangle>& triangles,
                                             const std::vector<Point>& points) {
  const auto place = [&](int v) -> const Point& { return points[static_cast<std::size_t>(v)]; };
  std::vector<Box> boxes;
  for (const Triangle& t : triangles) boxes.push_back(box_of_paths(t, points, points));
  SpatialHash hash;
  hash.build(boxes);
  std::vector<Intersection> found;
  std::vector<std::size_t> passed;
  for (const Edge& edge : edges) {
    const int i = edge[0], j = edge[1];  // clang 14 lets no lambda capture a structured binding
    passed.clear();
    hash.for_overlapping(box_of_paths(edge, points, points), [&](int k) {
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

namespace {

/// Returns the axes and diagonals of a cube, turned: no symmetry of meshes has these directions.
std::vector<Point> scattered_directions() {
  const Eigen::AngleAxisd turn(0.3713, Point(0.317, 0.593, 0.741).normalized());
  std::vector<Point> directions;
  for (int i = 0; i < 27; ++i) {
    const Point way = Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).cast<double>();
    if (way.cwiseAbs().sum() == 1 || way.cwiseAbs().sum() == 3) directions.push_back(turn * way.normalized());
  }
  return directions;
}

bool has_vertex(const Triangle& triangle, int v) { return std::ranges::find(triangle, v) != triangle.end(); }

}  // namespace

std::vector<Intersection> find_intersections_at_vertices(const std::vector<Edge>& edges,
                                                         const std::vector<Triangle>& triangles,
                                                         const std::vector<Point>& points) {
  const auto place = [&](int v) -> const Point& { return points[static_cast<std::size_t>(v)]; };
  std::map<int, std::vector<Edge>> spokes;
  for (const Edge& edge : edges) {
    for (const int v : edge) spokes[v].push_back(edge);
  }
  double largest = 0;
  for (const Point& point : points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  const double rounding = 2 * place_rounding * largest;
  std::vector<Box> boxes;
  for (const Triangle& t : triangles) boxes.push_back(box_of_paths(t, points, points));
  SpatialHash hash;
  hash.build(boxes);
  static const std::vector<Point> directions = scattered_directions();
  std::vector<Intersection> found;
  for (const auto& [vertex, around] : spokes) {
    const int v = vertex;  // clang 14 lets no lambda capture a structured binding
    const Point margin = Point::Constant(rounding);
    std::vector<std::size_t> touched;
    hash.for_overlapping(Box(place(v) - margin, place(v) + margin), [&](int k) {
      const Triangle& t = triangles[static_cast<std::size_t>(k)];
      if (has_vertex(t, v)) return;
      const double squared =
          nearest(Feature::vertex_triangle, {place(v), place(t[0]), place(t[1]), place(t[2])}).squared;
      if (squared <= rounding * rounding) touched.push_back(static_cast<std::size_t>(k));
    });
    if (touched.empty()) continue;
    std::ranges::sort(touched);
    double longest = 0;
    for (const auto& [i, j] : around) longest = std::max(longest, (place(i) - place(j)).norm());
    std::vector<Intersection> first;
    for (const Point& direction : directions) {
      const Point moved = 1e-6 * longest * direction;
      std::vector<Intersection> now;
      for (const Edge& edge : around) {
        for (const std::size_t k : touched) {
          const Triangle& t = triangles[k];
          if (has_vertex(t, edge[0]) || has_vertex(t, edge[1])) continue;
          if (passes_through(place(edge[0]) + moved, place(edge[1]) + moved, place(t[0]), place(t[1]), place(t[2]))) {
            now.push_back({edge, k});
          }
        }
      }
      if (first.empty()) first = now;
      if (now.empty()) {
        first.clear();
        break;
      }
    }
    found.insert(found.end(), first.begin(), first.end());
  }
  return found;
}

}  // namespace drape
