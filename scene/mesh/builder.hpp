#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// The most corners a face that is not convex can have: clipping its ears takes time that grows with their cube.
inline constexpr std::size_t most_concave_corners = 256;

/// Collects the vertices and polygons of a file into a Mesh.
class MeshBuilder {
 public:
  using Uv = std::array<float, 2>;

  /// Adds a vertex at a position [m]; vertices are numbered from 0 in the order they are added.
  void add_vertex(const Eigen::Vector3d& position) { positions_.push_back(position); }

  [[nodiscard]] std::size_t vertex_count() const { return positions_.size(); }
  [[nodiscard]] std::size_t triangle_count() const { return triangles_.size(); }

  /// Adds a polygon as triangles: a fan from its first corner where it is convex, else by clipping ears.
  /// @param corners at least 3, all below vertex_count()
  /// @param uvs one per corner, or empty
  /// @return false, and nothing is added, if it is concave with more than most_concave_corners corners
  [[nodiscard]] bool add_polygon(std::span<const int> corners, std::span<const Uv> uvs);

  /// The mesh; polygons without texture coordinates get (0, 0) if others have some.
  [[nodiscard]] Mesh finish();

 private:
  void add_triangle(const std::array<std::size_t, 3>& of, std::span<const int> corners, std::span<const Uv> uvs);

  std::vector<Eigen::Vector3d> positions_;
  std::vector<Triangle> triangles_;
  std::vector<Uv> uvs_;
};

/// The triangles of a polygon in space, as places in `points`, wound as the polygon is: points.size() − 2 of them. It
/// is clipped ear by ear (Meisters 1975) in the plane of its vector area (Newell's normal). A convex polygon gives the
/// fan (0,1,2), (0,2,3), …; where a polygon crosses itself the triangles still use each corner, but may overlap.
std::vector<std::array<std::size_t, 3>> triangulate(std::span<const Eigen::Vector3d> points);

}  // namespace drape
