#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// Largest number of corners of a concave face. Ear clipping takes time cubic in this number.
inline constexpr std::size_t most_concave_corners = 256;

/// Builder of a Mesh from the vertices and polygons of a file.
class MeshBuilder {
 public:
  using Uv = std::array<float, 2>;

  /// Adds a vertex at a position [m]. Vertices are numbered from 0 in the order of insertion.
  void add_vertex(const Eigen::Vector3d& position) { positions_.push_back(position); }

  [[nodiscard]] std::size_t vertex_count() const { return positions_.size(); }
  [[nodiscard]] std::size_t triangle_count() const { return triangles_.size(); }

  /// Adds a polygon as triangles: a fan from its first corner if convex, otherwise by ear clipping.
  /// @param corners at least 3, all below vertex_count()
  /// @param uvs one per corner, or empty
  /// @return false, without adding it, if the polygon is concave with more than most_concave_corners corners
  [[nodiscard]] bool add_polygon(std::span<const int> corners, std::span<const Uv> uvs);

  /// Returns the mesh. If some polygons have texture coordinates, the others get (0, 0).
  [[nodiscard]] Mesh finish();

 private:
  void add_triangle(const std::array<std::size_t, 3>& of, std::span<const int> corners, std::span<const Uv> uvs);

  std::vector<Eigen::Vector3d> positions_;
  std::vector<Triangle> triangles_;
  std::vector<Uv> uvs_;
};

/// Triangulates a polygon in space: returns points.size() − 2 triangles as indices into `points`, with the polygon's
/// winding. It clips ears (Meisters 1975) in the plane of the vector area (Newell's normal). A convex polygon gives the
/// fan (0,1,2), (0,2,3), …. A self-crossing polygon still uses each corner, but its triangles may overlap.
std::vector<std::array<std::size_t, 3>> triangulate(std::span<const Eigen::Vector3d> points);

}  // namespace drape
