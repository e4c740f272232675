#include "audit/stuck.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "audit/distance.hpp"

namespace drape::audit {
namespace {

constexpr double no_motion = 1e-9;  // relative to the mean edge
constexpr double fallen = 0.25;     // relative to an edge
constexpr double near = 0.5;        // relative to the mean edge
constexpr int fewest_steps = 2;

double distance_to(const std::vector<Triangle>& triangles, const Vertices& corners, const Eigen::Vector3d& p,
                   int but_of_vertex) {
  double square = HUGE_VAL;
  for (const Triangle& t : triangles) {
    if (std::ranges::find(t, but_of_vertex) != t.end()) continue;
    square = std::min(square, square_distance(p, {corners.row(t[0]).transpose(), corners.row(t[1]).transpose(),
                                                  corners.row(t[2]).transpose()}));
  }
  return std::sqrt(square);
}

/// Returns the gap between a point and a collider's contact layer, negative inside [m].
double gap_to(const Collider& collider, const Eigen::Vector3d& p) {
  if (const auto* sphere = std::get_if<SphereShape>(&collider)) {
    return (p - sphere->center).norm() - std::max(sphere->radius, sphere->reach);
  }
  if (const auto* ground = std::get_if<GroundShape>(&collider)) {
    return ground->normal.dot(p) - ground->height - ground->thickness;
  }
  const auto& mesh = std::get<MeshShape>(collider);
  return distance_to(*mesh.triangles, mesh.positions, p, -1) - mesh.thickness;
}

}  // namespace

StuckWatch::StuckWatch(const Topology& cloth, const Vertices& rest, const Held& held, Eigen::Vector3d down)
    : cloth_(cloth), held_known_(held.known), down_(std::move(down)) {
  const auto count = static_cast<std::size_t>(rest.rows());
  for (const auto& [a, b] : cloth.edges) mean_edge_ += (rest.row(a) - rest.row(b)).norm();
  mean_edge_ /= std::max<double>(1, static_cast<double>(cloth.edges.size()));
  held_.assign(count, held.known ? 0 : 1);
  for (const int v : held.vertices) held_.at(static_cast<std::size_t>(v)) = 1;
  still_.assign(count, 0);
  fall_.assign(count, 0);
}

std::vector<int> StuckWatch::add(const Vertices& x, const std::vector<Collider>& colliders) {
  std::vector<int> found;
  if (before_.rows() != x.rows()) {
    before_ = x;
    return found;
  }
  const Eigen::VectorXd drop = (x - before_) * down_;
  for (int v = 0; v < x.rows(); ++v) {
    const auto k = static_cast<std::size_t>(v);
    if ((x.row(v) - before_.row(v)).cwiseAbs().maxCoeff() <= no_motion * mean_edge_) {
      ++still_[k];
      continue;
    }
    still_[k] = 0;
    fall_[k] = 0;
    if (!held_known_) held_[k] = 0;
  }
  std::vector<double> most(still_.size(), 0);
  for (const auto& [a, b] : cloth_.edges) {
    const double length = (before_.row(a) - before_.row(b)).norm();
    if (!(length > 0)) continue;
    for (const auto& [v, other] : {std::pair(a, b), std::pair(b, a)}) {
      double& of = most[static_cast<std::size_t>(v)];
      of = std::max(of, drop[other] / length);
    }
  }
  before_ = x;
  for (int v = 0; v < x.rows(); ++v) {
    const auto k = static_cast<std::size_t>(v);
    if (still_[k] == 0) continue;
    fall_[k] += most[k];
    if (still_[k] < fewest_steps || fall_[k] < fallen || held_[k] != 0 || supported(v, x, colliders)) continue;
    found.push_back(v);
  }
  return found;
}

bool StuckWatch::supported(int vertex, const Vertices& x, const std::vector<Collider>& colliders) const {
  const Eigen::Vector3d p = x.row(vertex).transpose();
  const double reach = near * mean_edge_;
  return std::ranges::any_of(colliders, [&](const Collider& c) { return gap_to(c, p) <= reach; }) ||
         distance_to(cloth_.triangles, x, p, vertex) <= reach;
}

}  // namespace drape::audit
