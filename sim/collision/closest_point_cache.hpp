#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sim/collision/placed_mesh.hpp"

namespace drape {

/// Closest-point search on a mesh, with a cache of the triangles that were near each point. While a point and the mesh
/// move little, only these are tested. The cache changes no result. Points and mesh are in the mesh's coordinates. Data
/// are separate for each point, so threads may query different points concurrently.
class ClosestPointCache {
 public:
  /// @param reach search radius [m]
  ClosestPointCache(std::size_t points, double reach);

  /// Finds a point's closest point like PlacedMesh::find. Returns true if it is within the search radius.
  bool find(const PlacedMesh& mesh, std::size_t k, const Point& point, ClosestPoint& closest) {
    const Known& known = known_[k];
    // Scalars, as the point has just been computed and a vector would go through memory.
    const double x = point[0] - known.point[0], y = point[1] - known.point[1], z = point[2] - known.point[2];
    const double squared = x * x + y * y + z * z;
    if (mesh.travel() == known.travel && squared < known.clear_squared) return false;
    if (mesh.travel() != known.travel || !(squared < known.same_triangle_squared))
      return find_beyond_cache(mesh, k, point, closest);
    closest = mesh.closest_point(point, known.triangle, mesh.nearest_on(known.triangle, point));
    return closest.distance < reach_;
  }

 private:
  static constexpr std::size_t most = 8;
  /// Data that suffice if the point has moved little and the mesh not at all.
  struct Known {
    Point point = Point::Zero();
    double travel = 0;          // travel of the mesh at that time
    double clear_squared = -1;  // squared distance that it may move without coming within reach [m²]; negative: none
    double same_triangle_squared =
        -1;  // squared distance that it may move with the same nearest triangle [m²]; negative: none
    int triangle = -1;
  };
  /// Triangles that were near the point.
  struct Near {
    Point point = Point::Zero();
    double travel = 0;                    // travel of the mesh at that time
    int count = 0, asked = 0;             // queries since then
    double nearest = 0;                   // distance [m]
    double all_within = 0;                // complete up to this distance [m]
    std::array<double, most> least = {};  // lower bounds of their distances, ascending [m]
    std::array<int, most> triangles = {};
  };
  bool find_beyond_cache(const PlacedMesh& mesh, std::size_t k, const Point& point, ClosestPoint& closest);
  /// Searches the mesh for triangles near a point.
  void search(const PlacedMesh& mesh, const Point& point, Known& known, Near& near) const;
  /// Measures the cached triangles again from the point's position, `moved` from the previous one [m].
  static void remeasure(const PlacedMesh& mesh, const Point& point, double moved, double rounding, Near& near);
  bool find_among(const PlacedMesh& mesh, const Point& point, double moved, Known& known, const Near& near,
                  ClosestPoint& closest) const;
  /// Returns true if the nearest triangle must be in the list after distances changed by at most `moved` [m].
  [[nodiscard]] bool covers(const Near& near, double moved) const;

  double reach_;
  std::vector<Known> known_;
  std::vector<Near> near_;
};

}  // namespace drape
