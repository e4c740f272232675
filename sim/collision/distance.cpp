#include "sim/collision/distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>

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

}  // namespace drape
