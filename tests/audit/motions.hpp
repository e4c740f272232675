#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <vector>

#include "audit/crossings.hpp"
#include "tests/support/random.hpp"

namespace drape::audit {

/// Returns a grid of n×n cells in the xy plane, with each vertex moved randomly by up to `amount` per axis.
inline Vertices shaken_grid(const Mesh& grid, double amount, test::Random& random) {
  Vertices x = grid.positions;
  for (Eigen::Index v = 0; v < x.rows(); ++v) x.row(v) += amount * test::random_point(random).transpose();
  return x;
}

/// Rotates all positions about (1, 2, 3) by an angle [rad], then translates them.
inline Vertices moved(const Vertices& x, double angle, const Eigen::RowVector3d& shift) {
  const Eigen::AngleAxisd turn(angle, Eigen::Vector3d(1, 2, 3).normalized());
  return (x * turn.toRotationMatrix().transpose()).rowwise() + shift;
}

/// Joins both meshes.
inline Mesh joined(Mesh mesh, const Mesh& other) {
  const auto count = static_cast<int>(mesh.positions.rows());
  mesh.positions.conservativeResize(count + other.positions.rows(), Eigen::NoChange);
  mesh.positions.bottomRows(other.positions.rows()) = other.positions;
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + count, b + count, c + count});
  return mesh;
}

template <class Found>
std::string describe_all(const std::vector<Found>& found) {
  std::string text;
  for (const Found& one : found) text += describe(one) + '\n';
  return text;
}

}  // namespace drape::audit
