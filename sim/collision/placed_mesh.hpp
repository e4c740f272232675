#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "drape/sim/body_shape.hpp"
#include "drape/sim/mesh.hpp"
#include "sim/collision/distance.hpp"
#include "sim/collision/spatial_index.hpp"
#include "sim/parallel/loops.hpp"

namespace drape {

/// Connectivity of a mesh, which does not change with its motion.
struct MeshTopology {
  std::vector<Triangle> triangles;         ///< with three different vertices
  std::vector<std::array<int, 3>> across;  ///< neighbour across the edge from corner c to c + 1; −1: none
  Incidence around;                        ///< triangles at every vertex
  /// True for a closed, oriented mesh: each edge belongs to two triangles that run along it in opposite directions.
  bool closed = false;

  MeshTopology(const std::vector<Triangle>& all, int vertex_count);
};

/// Closest point of a mesh to a given point.
struct ClosestPoint {
  int triangle = -1;              ///< nearest triangle
  Point weights = Point::Zero();  ///< of its corners, at the closest point
  Point normal = Point::Zero();   ///< unit vector away from the mesh; outwards if the mesh is solid
  double distance = 0;            ///< [m]; negative inside a solid
};

/// A mesh at one position. A closed mesh is solid in either orientation; an open one is a shell with two equal sides.
/// The normal of the nearest feature tells inside from outside. It is the triangle's normal, the sum of both at an
/// edge, or an angle-weighted sum around a vertex (Bærentzen and Aanæs 2005, "Signed distance computation using the
/// angle weighted pseudonormal").
class PlacedMesh {
 public:
  /// @param travel see travel()
  PlacedMesh(std::shared_ptr<const MeshTopology> topology, const Vertices& x, double travel = 0);
  /// Moves the mesh to new positions.
  void place(const Vertices& x, double travel);

  /// Returns the closest point of the mesh. May return nothing if it is further than `reach` [m], unless the point is
  /// inside a solid.
  /// @param hint a triangle that may be the nearest; speeds up the search and does not change the result
  [[nodiscard]] std::optional<ClosestPoint> find(const Point& point, double reach, int hint = -1) const;

  /// Returns the closest point of a triangle to a point, like `nearest` for a vertex and a triangle.
  [[nodiscard]] Nearest nearest_on(int triangle, const Point& point) const {
    const Facet& facet = facets_[static_cast<std::size_t>(triangle)];
    const Point to = point - facet.corner;
    const double second = to.dot(facet.second), third = to.dot(facet.third);
    if (second >= 0 && third >= 0 && second + third <= 1) {
      const double height = to.dot(facet.normal);
      return {height * height, {1, second + third - 1, -second, -third}};
    }
    return nearest(Feature::vertex_triangle, {point, corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)});
  }
  /// Returns a cheap lower bound on the squared distance of a triangle [m²]. Adds the squared distances from its plane
  /// and from the line of an edge that the point is beyond.
  [[nodiscard]] double least_squared(int triangle, const Point& point) const {
    const Facet& facet = facets_[static_cast<std::size_t>(triangle)];
    const Point to = point - facet.corner;
    const double height = to.dot(facet.normal), second = to.dot(facet.second), third = to.dot(facet.third);
    const double first = 1 - second - third;
    // NaN fails the comparisons.
    double beyond = first < 0 ? first * first * facet.heights[0] : 0;
    if (second < 0) beyond = std::max(beyond, second * second * facet.heights[1]);
    if (third < 0) beyond = std::max(beyond, third * third * facet.heights[2]);
    return (1 - 1e-9) * (height * height + beyond);
  }
  /// Returns the result of find() for a given nearest triangle.
  [[nodiscard]] ClosestPoint closest_point(const Point& point, int triangle, const Nearest& near) const {
    const Facet& facet = facets_[static_cast<std::size_t>(triangle)];
    const std::array<double, 4>& w = near.weights;
    const bool inside = w[1] != 0 && w[2] != 0 && w[3] != 0;
    if (!inside || !(facet.heights[0] > 0)) return foot_on_edge(point, triangle, near);
    // The triangle's own normal pushes all points on a flat face in one direction.
    return on_its_side({triangle, {-w[1], -w[2], -w[3]}, facet.normal, facet.normal.dot(point - facet.corner)});
  }

  /// Returns an outward normal, not of unit length, at a triangle's feature: an edge or corner if weights are zero.
  [[nodiscard]] Point normal_at(int triangle, const Point& weights) const;

  /// Returns the outward unit normal of a triangle; zero without area.
  [[nodiscard]] const Point& face_normal(int triangle) const { return normals_[static_cast<std::size_t>(triangle)]; }
  /// Returns the travel of the mesh [m]: an upper bound on any point's displacement is the difference of two travels.
  [[nodiscard]] double travel() const { return travel_; }
  [[nodiscard]] bool solid() const { return topology_->closed; }
  [[nodiscard]] const MeshTopology& topology() const { return *topology_; }
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] const TriangleTree& tree() const { return tree_; }
  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

 private:
  /// A triangle as its plane and its barycentric coordinates in it. A degenerate one counts as its edges: NaN
  /// coordinates and a zero normal.
  struct Facet {
    Point corner, normal;  // first corner and outward unit normal
    Point second, third;   // the corner's weight at p is this vector times p − corner
    Point heights;         // squared heights of the corners above the opposite edges [m²]
  };

  void update(const Vertices& x);
  [[nodiscard]] const Point& corner(int triangle, std::size_t c) const {
    return points_[static_cast<std::size_t>(topology_->triangles[static_cast<std::size_t>(triangle)][c])];
  }
  [[nodiscard]] ClosestPoint foot_on_edge(const Point& point, int triangle, const Nearest& near) const;
  /// Returns true if the mesh encloses a point, by its winding number (Jacobson, Kavan and Sorkine-Hornung 2013,
  /// "Robust inside-outside segmentation using generalized winding numbers"). Visits every triangle.
  [[nodiscard]] bool encloses(const Point& point) const;
  /// Returns the closest point, on the point's own side if the mesh is a shell.
  [[nodiscard]] ClosestPoint on_its_side(ClosestPoint closest) const {
    if (!topology_->closed && closest.distance < 0) {
      closest.distance = -closest.distance;
      closest.normal = -closest.normal;
    }
    return closest;
  }

  std::shared_ptr<const MeshTopology> topology_;
  std::vector<Point> points_;
  std::vector<Point> normals_;  // outward unit normals of the triangles; zero without area
  std::vector<Facet> facets_;
  std::vector<Box> boxes_;
  TriangleTree tree_;
  double travel_;
};

/// A body at one moment: its mesh in its own coordinates, and the pose of these.
struct BodyAt {
  std::shared_ptr<const PlacedMesh> mesh;
  Pose pose;
};

/// A mesh with a rigid motion and a changing shape, as functions of time. Caches the shapes of the last few times, so
/// one object serves one thread at a time.
class MovingBody {
 public:
  MovingBody(std::shared_ptr<const MeshMotion> shape, RigidMotion motion);

  [[nodiscard]] BodyAt at(double time) const { return {mesh_at(time), motion_.at(time)}; }
  /// Returns true if the shape changes.
  [[nodiscard]] bool deforms() const { return !shape_->samples.empty(); }
  [[nodiscard]] const MeshTopology& topology() const { return *topology_; }

  /// Returns the vertices' positions in the world, n×3 [m].
  [[nodiscard]] Vertices positions(double time) const;

 private:
  struct Shape {
    double time;
    std::shared_ptr<PlacedMesh> mesh;
  };
  [[nodiscard]] std::shared_ptr<const PlacedMesh> mesh_at(double time) const;

  std::shared_ptr<const MeshMotion> shape_;
  RigidMotion motion_;
  std::shared_ptr<const MeshTopology> topology_;
  mutable std::vector<Shape> shapes_;  // most recently used last
  mutable Vertices scratch_, last_;    // last shape computed, and scratch
  mutable double travel_ = 0;
};

}  // namespace drape
