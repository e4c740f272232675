#include "sim/mesh_anchors.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <stdexcept>

namespace drape {
namespace {

using Eigen::Vector3d;

/// A value and its rate of change.
struct Moving {
  Vector3d value, rate;
};

Moving normalized(const Moving& v) {
  const double length = v.value.norm();
  if (length == 0) return {Vector3d::Zero(), Vector3d::Zero()};
  const Vector3d unit = v.value / length;
  return {unit, (v.rate - unit * unit.dot(v.rate)) / length};
}

Moving cross(const Moving& a, const Moving& b) {
  return {a.value.cross(b.value), a.rate.cross(b.value) + a.value.cross(b.rate)};
}

/// Returns the axes of a triangle's frame; zero without area.
std::array<Moving, 3> frame(const std::array<Moving, 3>& corners) {
  const auto edge = [&](std::size_t to) {
    return Moving{corners[to].value - corners[0].value, corners[to].rate - corners[0].rate};
  };
  const Moving along = normalized(edge(1)), normal = normalized(cross(edge(1), edge(2)));
  return {along, cross(normal, along), normal};
}

/// Returns the barycentric coordinates of a triangle's closest point to p (Ericson, Real-Time Collision Detection,
/// 5.1.5).
Vector3d nearest_weights(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double of_c = d1 * d4 - d3 * d2, of_b = d5 * d2 - d1 * d6, of_a = d3 * d6 - d5 * d4;
  if (of_c <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (of_b <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  if (of_a <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double share = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - share, share};
  }
  const double sum = of_a + of_b + of_c;
  return {of_a / sum, of_b / sum, of_c / sum};
}

}  // namespace

MeshAnchors::MeshAnchors(const MeshMotion& motion, const Vertices& points, double time) {
  Vertices at_first;
  motion.place(time, at_first);
  attach(at_first, motion.mesh.triangles, points);

  // Keep only the vertices with an anchor: hands hold few vertices of a body.
  std::vector<int> held;
  for (const Anchor& anchor : anchors_) held.insert(held.end(), anchor.corners.begin(), anchor.corners.end());
  std::ranges::sort(held);
  held.erase(std::unique(held.begin(), held.end()), held.end());
  for (Anchor& anchor : anchors_) {
    for (int& corner : anchor.corners) {
      corner = static_cast<int>(std::ranges::lower_bound(held, corner) - held.begin());
    }
  }
  times_ = motion.samples.empty() ? std::vector<double>{time} : motion.times;
  for (std::size_t s = 0; s < times_.size(); ++s) {
    samples_.push_back((motion.samples.empty() ? at_first : motion.samples[s])(held, Eigen::all));
  }
}

void MeshAnchors::attach(const Vertices& at_first, const std::vector<Triangle>& triangles, const Vertices& points) {
  for (Eigen::Index k = 0; k < points.rows(); ++k) {
    const Vector3d point = points.row(k).transpose();
    Anchor best;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Triangle& triangle : triangles) {
      const Vector3d a = at_first.row(triangle[0]), b = at_first.row(triangle[1]), c = at_first.row(triangle[2]);
      if ((b - a).cross(c - a).isZero(0)) continue;
      const Vector3d weights = nearest_weights(a, b, c, point);
      const Vector3d from = point - (weights[0] * a + weights[1] * b + weights[2] * c);
      if (from.squaredNorm() >= nearest) continue;
      nearest = from.squaredNorm();
      const auto axes = frame({Moving{a, {}}, Moving{b, {}}, Moving{c, {}}});
      best = {triangle, weights, {from.dot(axes[0].value), from.dot(axes[1].value), from.dot(axes[2].value)}};
    }
    if (nearest == std::numeric_limits<double>::infinity()) {
      throw std::invalid_argument("a mesh to hold on to needs a triangle with an area");
    }
    anchors_.push_back(best);
  }
}

MeshAnchors::Place MeshAnchors::at(std::size_t k, double time) const {
  const Anchor& anchor = anchors_[k];
  // At a sample use the interval before it, so that the velocity is the one of arrival.
  const auto after = static_cast<std::size_t>(std::ranges::lower_bound(times_, time) - times_.begin());
  const bool moves = after > 0 && after < times_.size();
  const Vertices& from = samples_[after > 0 ? after - 1 : 0];
  const Vertices& to = samples_[moves ? after : (after > 0 ? after - 1 : 0)];
  const double span = moves ? times_[after] - times_[after - 1] : 1;
  const double share = moves ? (time - times_[after - 1]) / span : 0;
  std::array<Moving, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d a = from.row(anchor.corners[i]), b = to.row(anchor.corners[i]);
    corners[i] = {a + share * (b - a), (b - a) / span};
  }
  Place place{Vector3d::Zero(), Vector3d::Zero()};
  const std::array<Moving, 3> axes = frame(corners);
  for (int i = 0; i < 3; ++i) {
    const auto corner = static_cast<std::size_t>(i);
    place.position += anchor.weights[i] * corners[corner].value + anchor.offset[i] * axes[corner].value;
    place.velocity += anchor.weights[i] * corners[corner].rate + anchor.offset[i] * axes[corner].rate;
  }
  return place;
}

}  // namespace drape
