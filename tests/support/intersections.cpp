#include "tests/support/intersections.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace drape::test {
namespace {

using Point = Eigen::Vector3d;

double volume(const Point& a, const Point& b, const Point& c, const Point& d) {
  return (b - a).cross(c - a).dot(d - a);
}

bool pierces(const Point& p, const Point& q, const Point& a, const Point& b, const Point& c) {
  if ((volume(a, b, c, p) > 0) == (volume(a, b, c, q) > 0)) return false;
  const bool ab = volume(p, q, a, b) > 0, bc = volume(p, q, b, c) > 0, ca = volume(p, q, c, a) > 0;
  return ab == bc && bc == ca;
}

struct Reach {
  Point low, high;
  bool meets(const Reach& o) const {
    return (low.array() <= o.high.array()).all() && (o.low.array() <= high.array()).all();
  }
};

template <std::size_t n>
Reach reach(const std::array<int, n>& vertices, const Vertices& from, const Vertices& to) {
  Reach r{from.row(vertices[0]).transpose(), from.row(vertices[0]).transpose()};
  for (const int v : vertices) {
    for (const Vertices* x : {&from, &to}) {
      r.low = r.low.cwiseMin(x->row(v).transpose());
      r.high = r.high.cwiseMax(x->row(v).transpose());
    }
  }
  return r;
}

bool share(const Edge& e, const Triangle& t) {
  return std::any_of(t.begin(), t.end(), [&](int v) { return v == e[0] || v == e[1]; });
}

/// Returns the roots of a + b t + c t² + d t³ in [0, 1] at which it changes its sign.
std::vector<double> sign_changes(double a, double b, double c, double d) {
  const auto value = [&](double t) { return a + t * (b + t * (c + t * d)); };
  std::vector<double> ends{0};
  const double discriminant = c * c - 3 * b * d;
  if (discriminant >= 0) {
    const double q = -(c + std::copysign(std::sqrt(discriminant), c));
    for (const double t : {q / (3 * d), b / q}) {
      if (t > 0 && t < 1) ends.push_back(t);
    }
  }
  ends.push_back(1);
  std::sort(ends.begin(), ends.end());
  std::vector<double> roots;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    double low = ends[i - 1], high = ends[i];
    if ((value(low) > 0) == (value(high) > 0)) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      ((value(middle) > 0) == (value(low) > 0) ? low : high) = middle;
    }
    roots.push_back(high);
  }
  return roots;
}

struct Four {
  std::array<Point, 4> at, move;
  Four(const std::array<int, 4>& v, const Vertices& from, const Vertices& to) {
    for (std::size_t i = 0; i < 4; ++i) {
      at[i] = from.row(v[i]).transpose();
      move[i] = (to.row(v[i]) - from.row(v[i])).transpose();
    }
  }
  std::vector<double> coplanar_times() const {
    const Point b = at[1] - at[0], c = at[2] - at[0], d = at[3] - at[0];
    const Point u = move[1] - move[0], v = move[2] - move[0], w = move[3] - move[0];
    return sign_changes(b.cross(c).dot(d), u.cross(c).dot(d) + b.cross(v).dot(d) + b.cross(c).dot(w),
                        u.cross(v).dot(d) + u.cross(c).dot(w) + b.cross(v).dot(w), u.cross(v).dot(w));
  }
  Point place(std::size_t i, double t) const { return at[i] + t * move[i]; }
};

/// Returns true if vertex 0 passes through the triangle of the others.
bool vertex_crosses(const Four& f) {
  return std::ranges::any_of(f.coplanar_times(), [&](double t) {
    const Point p = f.place(0, t), a = f.place(1, t), b = f.place(2, t), c = f.place(3, t);
    const Point n = (b - a).cross(c - a);
    return (b - a).cross(p - a).dot(n) > 0 && (c - b).cross(p - b).dot(n) > 0 && (a - c).cross(p - c).dot(n) > 0;
  });
}

/// Returns true if edge 0–1 passes through edge 2–3.
bool edges_cross(const Four& f) {
  return std::ranges::any_of(f.coplanar_times(), [&](double t) {
    const Point a = f.place(0, t), b = f.place(1, t), c = f.place(2, t), d = f.place(3, t);
    const Point n = (b - a).cross(d - c);
    const double s = (c - a).cross(d - c).dot(n) / n.squaredNorm(), r = (c - a).cross(b - a).dot(n) / n.squaredNorm();
    return s > 0 && s < 1 && r > 0 && r < 1;
  });
}

}  // namespace

int self_intersections(const std::vector<Triangle>& triangles, const Vertices& x) {
  const auto point = [&](int v) -> Point { return x.row(v).transpose(); };
  int count = 0;
  std::vector<Reach> reaches;
  for (const Triangle& t : triangles) reaches.push_back(reach(t, x, x));
  for (const Edge& e : unique_edges(triangles)) {
    const Reach along = reach(e, x, x);
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      const Triangle& t = triangles[k];
      if (!along.meets(reaches[k]) || share(e, t)) continue;
      count += pierces(point(e[0]), point(e[1]), point(t[0]), point(t[1]), point(t[2])) ? 1 : 0;
    }
  }
  return count;
}

int self_crossings(const std::vector<Triangle>& triangles, const Vertices& from, const Vertices& to) {
  int count = 0;
  std::vector<Reach> reaches;
  for (const Triangle& t : triangles) reaches.push_back(reach(t, from, to));
  for (int v = 0; v < static_cast<int>(from.rows()); ++v) {
    const Reach way = reach(std::array{v}, from, to);
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      const auto& [a, b, c] = triangles[k];
      if (v == a || v == b || v == c || !way.meets(reaches[k])) continue;
      count += vertex_crosses(Four({v, a, b, c}, from, to)) ? 1 : 0;
    }
  }
  const std::vector<Edge> edges = unique_edges(triangles);
  std::vector<Reach> ways;
  for (const Edge& e : edges) ways.push_back(reach(e, from, to));
  for (std::size_t k = 0; k < edges.size(); ++k) {
    for (std::size_t l = k + 1; l < edges.size(); ++l) {
      const auto& [a, b] = edges[k];
      const auto& [c, d] = edges[l];
      if (a == c || a == d || b == c || b == d || !ways[k].meets(ways[l])) continue;
      count += edges_cross(Four({a, b, c, d}, from, to)) ? 1 : 0;
    }
  }
  return count;
}

}  // namespace drape::test
