#include "sim/collision/rigid_zones.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace drape {
namespace {

using Index = std::size_t;

/// Returns ω with inertia·ω = momentum, without rotation about axes of zero inertia, as for collinear vertices.
Point angular_velocity(const Eigen::Matrix3d& inertia, const Point& momentum) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(inertia);
  const double largest = axes.eigenvalues()[2];
  Point result = Point::Zero();
  for (int k = 0; k < 3; ++k) {
    if (!(axes.eigenvalues()[k] > 1e-9 * largest)) continue;
    const Point axis = axes.eigenvectors().col(k);
    result += axis.dot(momentum) / axes.eigenvalues()[k] * axis;
  }
  return result;
}

}  // namespace

void RigidZones::begin(const std::vector<Point>& velocities) {
  velocities_ = velocities;
  parents_.resize(velocities.size());
  std::iota(parents_.begin(), parents_.end(), 0);
}

int RigidZones::root(int vertex) const {
  while (parents_[Index(vertex)] != vertex) vertex = parents_[Index(vertex)];
  return vertex;
}

void RigidZones::join(const std::array<int, 4>& vertices) {
  int lowest = root(vertices[0]);
  for (const int v : vertices) lowest = std::min(lowest, root(v));
  for (const int v : vertices) {
    parents_[Index(root(v))] = lowest;
    parents_[Index(v)] = lowest;
  }
}

void RigidZones::join_all() {
  int first = -1;
  for (int v = 0; v < static_cast<int>(parents_.size()); ++v) {
    if (root(v) == v) continue;
    if (first < 0) first = root(v);
    parents_[Index(root(v))] = first;
  }
}

bool RigidZones::together(const std::array<int, 4>& vertices) const {
  const int first = root(vertices[0]);
  return std::all_of(vertices.begin() + 1, vertices.end(), [&](int v) { return root(v) == first; });
}

void RigidZones::sum_up(const std::vector<Point>& x, const MovingVertices& vertices) {
  const int count = static_cast<int>(parents_.size());
  std::vector<char>& in_zone = zone_roots_;
  in_zone.assign(Index(count), 0);
  for (int v = 0; v < count; ++v) {
    if (root(v) != v) in_zone[Index(root(v))] = 1;
  }
  members_.clear();
  bodies_.resize(Index(count));
  for (int v = 0; v < count; ++v) {
    if (in_zone[Index(root(v))] == 0) continue;
    members_.push_back(v);
    if (root(v) == v) bodies_[Index(v)] = {};
  }
  for (const int v : members_) {
    Body& body = bodies_[Index(root(v))];
    const Point& velocity = velocities_[Index(v)];
    if (vertices.inverse_mass(v) == 0) {
      if (body.pins == 0) {
        body.velocity = velocity;
      } else if (velocity != body.velocity) {
        body.uneven = true;
      }
      ++body.pins;
    }
  }
  for (const int v : members_) {
    Body& body = bodies_[Index(root(v))];
    if (body.pins > 0) continue;
    const double mass = 1 / vertices.inverse_mass(v);
    body.mass += mass;
    body.center += mass * x[Index(v)];
    body.velocity += mass * velocities_[Index(v)];
  }
  for (const int v : members_) {
    Body& body = bodies_[Index(v)];
    if (root(v) != v || body.pins > 0) continue;
    body.center /= body.mass;
    body.velocity /= body.mass;
  }
  for (const int v : members_) {
    Body& body = bodies_[Index(root(v))];
    if (body.pins > 0) continue;
    const double mass = 1 / vertices.inverse_mass(v);
    const Point arm = x[Index(v)] - body.center;
    body.angular_momentum += mass * arm.cross(velocities_[Index(v)] - body.velocity);
    body.inertia += mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
  }
}

bool RigidZones::apply(const std::vector<Point>& x, MovingVertices& vertices) {
  sum_up(x, vertices);
  bool rigid = true;
  for (const int v : members_) {
    Body& body = bodies_[Index(v)];
    if (root(v) != v) continue;
    if (body.pins == 0) body.spin = angular_velocity(body.inertia, body.angular_momentum);
    rigid = rigid && !body.uneven;
  }
  for (const int v : members_) {
    const Body& body = bodies_[Index(root(v))];
    if (vertices.inverse_mass(v) == 0) continue;
    vertices.velocities[Index(v)] = body.velocity + body.spin.cross(x[Index(v)] - body.center);
  }
  return rigid;
}

}  // namespace drape
