#include "sim/collision/monotone_sheet.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "sim/collision/candidates.hpp"

namespace drape {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double flatness =
    1e-9;                        // largest distance from the plane, and least turn of the outline, relative to the size
constexpr double margin = 1.01;  // for rounding errors
constexpr double least_ratio = 1e-6;  // of the squared stretches along the mean plane, the smaller to the larger
constexpr double reach = 2;           // search radius for close features in the flat shape, in distances

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Returns coordinates in the plane of the rest shape [m]; nothing if it is not flat.
std::optional<std::vector<Vector2d>> flat_shape(const Cloth& cloth) {
  const double size = (cloth.rest.colwise().maxCoeff() - cloth.rest.colwise().minCoeff()).norm();
  const auto at = [&](int v) -> Point { return cloth.rest.row(v).transpose(); };
  const Triangle& t = cloth.triangles.front();
  const Point origin = at(t[0]), first = (at(t[1]) - origin).normalized();
  const Point normal = first.cross(at(t[2]) - origin).normalized(), second = normal.cross(first);
  std::vector<Vector2d> points;
  for (int v = 0; v < cloth.vertex_count(); ++v) {
    const Point d = at(v) - origin;
    if (!(std::abs(normal.dot(d)) <= flatness * size)) return std::nullopt;
    points.emplace_back(first.dot(d), second.dot(d));
  }
  return points;
}

/// Returns true if the triangles fill one convex polygon and touch every vertex.
bool is_convex(const std::vector<Triangle>& triangles, const std::vector<Vector2d>& points) {
  std::map<std::array<int, 2>, int> sides;
  std::vector<char> used(points.size());
  double area = 0, size = 0;
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      used[static_cast<std::size_t>(t[k])] = 1;
      ++sides[{t[k], t[(k + 1) % 3]}];
    }
    const auto p = [&](std::size_t k) { return points[static_cast<std::size_t>(t[k])]; };
    const double twice = cross(p(1) - p(0), p(2) - p(0));
    if (!(twice > 0)) return false;
    area += twice;
    size = std::max({size, (p(1) - p(0)).norm(), (p(2) - p(0)).norm()});
  }
  std::map<int, int> outline;  // next vertex of each boundary vertex
  for (const auto& [side, count] : sides) {
    if (count > 1) return false;
    if (!sides.contains({side[1], side[0]}) && !outline.emplace(side[0], side[1]).second) return false;
  }
  if (outline.empty() || std::ranges::count(used, 0) > 0) return false;
  double enclosed = 0, turned = 0;
  std::size_t count = 0;
  for (int v = outline.begin()->first; count < outline.size(); ++count) {
    const int next = outline.at(v), after = outline.at(next);
    const auto p = [&](int i) { return points[static_cast<std::size_t>(i)]; };
    const Vector2d in = p(next) - p(v), out = p(after) - p(next);
    const double turn = std::atan2(cross(in, out), in.dot(out));
    if (turn < -flatness) return false;
    turned += turn;
    enclosed += cross(p(v), p(next));
    v = next;
  }
  return std::abs(turned - 2 * M_PI) < 1e-6 && std::abs(enclosed - area) <= 1e-9 * area;
}

/// Returns the least distance in the flat shape of two features without a common vertex, or `most` if that is less [m].
double closest_features(const Cloth& cloth, double most) {
  std::vector<Point> rest;
  for (int v = 0; v < cloth.vertex_count(); ++v) rest.emplace_back(cloth.rest.row(v).transpose());
  CollisionCandidates candidates(cloth);
  candidates.find(rest, rest, most);
  double squared = most * most;
  for (const FeaturePair& pair : candidates.pairs()) {
    squared = std::min(squared, nearest(pair.feature, gather(rest, pair.vertices)).squared);
  }
  return std::sqrt(squared);
}

}  // namespace

MonotoneSheet::MonotoneSheet(const Cloth& cloth, double distance) {
  if (cloth.triangles.empty()) return;
  if (cloth.pieces.size() > 1) return;
  const auto points = flat_shape(cloth);
  if (!points || !is_convex(cloth.triangles, *points)) return;
  least_ = margin * distance / closest_features(cloth, reach * distance);
  if (!(least_ < 1)) return;
  weights_.resize(points->size(), {0, 0});
  for (const Triangle& t : cloth.triangles) {
    const auto p = [&](std::size_t k) { return (*points)[static_cast<std::size_t>(t[k])]; };
    Matrix2d edges;
    edges << p(1) - p(0), p(2) - p(0);
    const Matrix2d inverse = edges.inverse(), share = edges.determinant() / 2 * inverse;
    triangles_.push_back({t, {inverse(0, 0), inverse(0, 1), inverse(1, 0), inverse(1, 1)}});
    for (Eigen::Index c = 0; c < 2; ++c) {
      const auto j = static_cast<std::size_t>(c);
      weights_[static_cast<std::size_t>(t[0])][j] -= share(0, c) + share(1, c);
      weights_[static_cast<std::size_t>(t[1])][j] += share(0, c);
      weights_[static_cast<std::size_t>(t[2])][j] += share(1, c);
    }
  }
  projected_.resize(points->size());
}

bool MonotoneSheet::choose_plane(const std::vector<Point>& x) {
  Eigen::Matrix<double, 3, 2> mean = Eigen::Matrix<double, 3, 2>::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean.col(0) += weights_[i][0] * x[i];
    mean.col(1) += weights_[i][1] * x[i];
  }
  // The rotation of the polar decomposition F·(FᵀF)^(−1/2): with it the mean gradient F is symmetric.
  const Matrix2d squared = mean.transpose() * mean;
  const double trace = squared.trace(), determinant = squared.determinant();
  if (!(determinant > least_ratio * trace * trace)) return false;
  const double root = std::sqrt(determinant);
  // The square root of a symmetric 2×2 matrix S, by the theorem of Cayley and Hamilton: (S + √det S)/√(tr S + 2√det S).
  const Matrix2d stretch = (squared + root * Matrix2d::Identity()) / std::sqrt(trace + 2 * root);
  const Eigen::Matrix<double, 3, 2> axes = mean * stretch.inverse();
  first_ = axes.col(0);
  second_ = axes.col(1);
  return true;
}

bool MonotoneSheet::is_monotone(const std::vector<Point>& x) {
  for (std::size_t i = 0; i < x.size(); ++i) projected_[i] = {first_.dot(x[i]), second_.dot(x[i])};
  for (const FlatTriangle& t : triangles_) {
    const auto& a = projected_[static_cast<std::size_t>(t.vertices[0])];
    const auto& b = projected_[static_cast<std::size_t>(t.vertices[1])];
    const auto& c = projected_[static_cast<std::size_t>(t.vertices[2])];
    const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - a[0], vy = c[1] - a[1];
    const auto& m = t.inverse;
    const double xx = ux * m[0] + vx * m[2] - least_, yy = uy * m[1] + vy * m[3] - least_;
    const double xy = 0.5 * (ux * m[1] + vx * m[3] + uy * m[0] + vy * m[2]);
    if (!(xx > 0 && xx * yy > xy * xy)) return false;
  }
  return true;
}

void MonotoneSheet::begin(const std::vector<Point>& from) {
  from_ = &from;
  earlier_plane_ = !apart_at_.empty() && apart_at_ == from;
  if (earlier_plane_) {
    starts_apart_ = true;
  } else {
    test_start();
  }
}

bool MonotoneSheet::stays_apart(const std::vector<Point>& to) {
  bool apart = starts_apart_ && is_monotone(to);
  if (!apart && earlier_plane_) {
    earlier_plane_ = false;
    test_start();
    apart = starts_apart_ && is_monotone(to);
  }
  if (apart) {
    apart_at_ = to;
  } else {
    apart_at_.clear();
  }
  return apart;
}

std::vector<Patch> make_patches(const std::vector<Triangle>& triangles, int first, int vertex_count) {
  const std::vector<Edge> edges = unique_edges(triangles);
  std::vector<char> edge_taken(edges.size(), 0), vertex_taken(static_cast<std::size_t>(vertex_count), 0);
  std::vector<Patch> patches;
  patches.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    Patch patch{{first + t[0], first + t[1], first + t[2]}, {}, {}};
    for (std::size_t c = 0; c < 3; ++c) {
      const int p = t[c], q = t[(c + 1) % 3];
      patch.own_vertex[c] = std::exchange(vertex_taken[static_cast<std::size_t>(p)], 1) == 0;
      if (p == q) continue;
      const auto edge = std::ranges::lower_bound(edges, Edge{std::min(p, q), std::max(p, q)}) - edges.begin();
      patch.own_edge[c] = std::exchange(edge_taken[static_cast<std::size_t>(edge)], 1) == 0;
    }
    patches.push_back(patch);
  }
  return patches;
}

}  // namespace drape
