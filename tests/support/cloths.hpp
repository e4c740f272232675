#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/sphere.hpp"
#include "drape/sim/settings.hpp"

namespace drape::test {

/// Makes a grid like the homework's, 1 kg, pinned at two corners.
inline Cloth grid_cloth(int cells, double stiffness = 180) {
  const Mesh grid = make_grid(cells, cells);
  return make_cloth(grid, grid, 1.0, stiffness, {0, cells});
}

/// Makes a bent sheet with shuffled vertex numbers, so that its springs have no regular order.
inline Cloth irregular_cloth(double stiffness = 180) {
  Mesh mesh = make_grid(9, 7);
  const int n = static_cast<int>(mesh.positions.rows());
  const auto shuffled = [n](int v) { return v * 37 % n; };  // n = 80 and 37 have no common divisor
  Mesh result = mesh;
  for (int v = 0; v < n; ++v) {
    Eigen::RowVector3d p = mesh.positions.row(v);
    p += Eigen::RowVector3d(0.03 * std::sin(7.0 * v), 0.03 * std::cos(5.0 * v), 0.1 * std::sin(3.0 * v));
    result.positions.row(shuffled(v)) = p;
  }
  for (Triangle& triangle : result.triangles) {
    for (int& v : triangle) v = shuffled(v);
  }
  return make_cloth(result, result, 1.0, stiffness, {shuffled(0), shuffled(5)});
}

/// Makes three sheets that meet in one edge, and an isolated vertex.
inline Cloth non_manifold_cloth(double stiffness = 180) {
  Mesh mesh;
  mesh.positions.resize(6, 3);
  mesh.positions << 0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, -1, 0.2, 0.5, 0, 1, 5, 5, 5;
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  return make_cloth(mesh, mesh, 1.0, stiffness, {2});
}

/// Makes the cloth move, with some springs stretched and others compressed.
inline Cloth disturbed(Cloth cloth) {
  for (Eigen::Index v = 0; v < cloth.positions.rows(); ++v) {
    const auto t = static_cast<double>(v);
    cloth.positions.row(v) += Eigen::RowVector3d(0.04 * std::sin(3 * t), 0.05 * std::cos(2 * t), 0.06 * std::sin(t));
    cloth.velocities.row(v) << std::cos(t), std::sin(2 * t), -1;
  }
  return cloth;
}

/// Returns a fabric by its name in scenes.
inline const Fabric& fabric(std::string_view name) {
  const auto found = std::ranges::find(fabrics(), name, &Fabric::name);
  if (found == fabrics().end()) throw std::out_of_range(std::string(name));
  return *found;
}

/// Makes the homework's sphere, below the cloth.
inline Sphere sphere() { return {.center = Eigen::Vector3d(0, 0, -0.5), .radius = 0.4}; }

}  // namespace drape::test
