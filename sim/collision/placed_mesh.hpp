#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "sim/collision/distance.hpp"
#include "sim/collision/triangle_tree.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// How a mesh's triangles hang together, which does not change when it moves.
struct MeshTopology {
  std::vector<Triangle> triangles;         ///< those of three different vertices
  std::vector<std::array<int, 3>> across;  ///< of each, the triangle beyond the edge from corner c to c + 1; −1: none
  std::vector<int> starts, around;         ///< around[starts[v]], …: the triangles at vertex v
  /// Whether it encloses something: every edge is between two triangles that run along it in opposite directions.
  bool closed = false;

  MeshTopology(const std::vector<Triangle>& all, int vertex_count);
};

/// Where a point is beside a mesh.
struct Foot {
  int triangle = -1;              ///< the nearest one
  Point weights = Point::Zero();  ///< of its corners, at its nearest point
  Point normal = Point::Zero();   ///< unit vector away from the mesh, out of it where it is solid
  double distance = 0;            ///< negative inside of what is solid [m]
};

/// A mesh at one place. A closed one is solid, whichever way round its triangles are; another is a shell, whose two
/// sides are alike. Inside and outside are told apart by the normal of the feature that is nearest: of a triangle, of
/// both triangles at an edge, or of those around a vertex weighted by their angles (Bærentzen and Aanæs 2005, "Signed
/// distance computation using the angle weighted pseudonormal").
class PlacedMesh {
 public:
  PlacedMesh(std::shared_ptr<const MeshTopology> topology, const Vertices& x);
  /// Moves it elsewhere.
  void place(const Vertices& x);

  /// The nearest point of the mesh. Where it is further away than `reach` [m], and not because the point is inside of
  /// what is solid, it need not be found.
  /// @param hint a triangle that may be the nearest, which makes it fast: it changes nothing about what is found
  [[nodiscard]] std::optional<Foot> find(const Point& point, double reach, int hint = -1) const;

  /// Out of the mesh at a feature of a triangle: of an edge or a corner where weights are zero. Not of unit length.
  [[nodiscard]] Point normal_at(int triangle, const Point& weights) const;

  /// Unit vector out of a triangle; zero without an area.
  [[nodiscard]] const Point& face_normal(int triangle) const { return normals_[static_cast<std::size_t>(triangle)]; }
  /// How often it has been moved.
  [[nodiscard]] int moves() const { return moves_; }
  [[nodiscard]] bool solid() const { return topology_->closed; }
  [[nodiscard]] const MeshTopology& topology() const { return *topology_; }
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] const TriangleTree& tree() const { return tree_; }
  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

 private:
  void update(const Vertices& x);
  [[nodiscard]] const Point& corner(int triangle, std::size_t c) const;
  [[nodiscard]] Foot foot(const Point& point, int triangle, const Nearest& near) const;

  std::shared_ptr<const MeshTopology> topology_;
  std::vector<Point> points_;
  std::vector<Point> normals_;  // of the triangles, unit vectors outwards; zero without an area
  std::vector<Box> boxes_;
  TriangleTree tree_;
  int moves_ = 0;
};

}  // namespace drape
