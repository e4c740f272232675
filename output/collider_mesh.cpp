#include "output/collider_mesh.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "core/rotation.hpp"

namespace drape {
namespace {

constexpr int around = 48, from_pole_to_pole = 24;

/// Appends points and returns the index of the first.
int append(Surface& surface, const Vertices& points) {
  const Eigen::Index first = surface.positions.rows();
  surface.positions.conservativeResize(first + points.rows(), 3);
  surface.positions.bottomRows(points.rows()) = points;
  return static_cast<int>(first);
}

void append(Surface& surface, const SphereShape& sphere) {
  constexpr int rings = from_pole_to_pole - 1;
  constexpr Eigen::Index poles = Eigen::Index{rings} * around;  // index of the first pole
  Vertices points(poles + 2, 3);
  for (int i = 0; i < rings; ++i) {
    const double polar = std::numbers::pi * (i + 1) / from_pole_to_pole;
    for (int j = 0; j < around; ++j) {
      const double azimuth = 2 * std::numbers::pi * j / around;
      points.row(i * around + j) << std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
          std::cos(polar);
    }
  }
  points.row(poles) << 0, 0, 1;
  points.row(poles + 1) << 0, 0, -1;
  points = (sphere.radius * points).rowwise() + sphere.center.transpose();

  const int first = append(surface, points), north = first + rings * around, south = north + 1;
  for (int j = 0; j < around; ++j) {
    const int next = (j + 1) % around;
    for (int i = 0; i + 1 < rings; ++i) {
      const int a = first + i * around + j, b = first + i * around + next;
      surface.triangles.push_back({a, a + around, b + around});
      surface.triangles.push_back({a, b + around, b});
    }
    surface.triangles.push_back({north, first + j, first + next});
    surface.triangles.push_back({south, first + (rings - 1) * around + next, first + (rings - 1) * around + j});
  }
}

}  // namespace

GroundPatch ground_patch(const Vertices& cloth) {
  if (cloth.rows() == 0) return {};
  const Eigen::RowVector3d low = cloth.colwise().minCoeff(), high = cloth.colwise().maxCoeff();
  return {.middle = (low + high) / 2, .side = 4 * (high - low).maxCoeff()};
}

Vertices ground_corners(const GroundShape& ground, const GroundPatch& patch) {
  const Eigen::Vector3d& n = ground.normal;
  const Eigen::Vector3d middle = patch.middle + (ground.height - n.dot(patch.middle)) * n;
  // The sides of a level ground are along x and y.
  const Eigen::Quaterniond turn = rotation_from_z(n);
  const Eigen::Vector3d x = patch.side / 2 * (turn * Eigen::Vector3d::UnitX()),
                        y = patch.side / 2 * (turn * Eigen::Vector3d::UnitY());
  Vertices corners(4, 3);
  corners << (middle - x - y).transpose(), (middle + x - y).transpose(), (middle + x + y).transpose(),
      (middle - x + y).transpose();
  return corners;
}

Surface surface_of(const std::vector<Collider>& colliders, const GroundPatch& patch) {
  Surface surface{.positions = Vertices(0, 3), .triangles = {}};
  for (const Collider& collider : colliders) {
    if (const auto* sphere = std::get_if<SphereShape>(&collider)) {
      append(surface, *sphere);
    } else if (const auto* ground = std::get_if<GroundShape>(&collider)) {
      const int first = append(surface, ground_corners(*ground, patch));
      surface.triangles.push_back({first, first + 1, first + 2});
      surface.triangles.push_back({first, first + 2, first + 3});
    } else if (const auto* mesh = std::get_if<MeshShape>(&collider)) {
      const int first = append(surface, mesh->positions);
      for (const auto& [a, b, c] : *mesh->triangles) surface.triangles.push_back({first + a, first + b, first + c});
    }
  }
  return surface;
}

}  // namespace drape
