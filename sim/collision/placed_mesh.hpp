#pragma once

#include <algorithm>
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
  /// @param travel see travel()
  PlacedMesh(std::shared_ptr<const MeshTopology> topology, const Vertices& x, double travel = 0);
  /// Moves it elsewhere.
  void place(const Vertices& x, double travel);

  /// The nearest point of the mesh. Where it is further away than `reach` [m], and not because the point is inside of
  /// what is solid, it need not be found.
  /// @param hint a triangle that may be the nearest, which makes it fast: it changes nothing about what is found
  [[nodiscard]] std::optional<Foot> find(const Point& point, double reach, int hint = -1) const;

  /// The nearest point of a triangle to one that is there, as `nearest` says it of a vertex and a triangle.
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
  /// The square of a distance that it is not nearer than, which is cheaper: that from its plane, and from a line along
  /// an edge beyond which the point is [m²].
  [[nodiscard]] double least_squared(int triangle, const Point& point) const {
    const Facet& facet = facets_[static_cast<std::size_t>(triangle)];
    const Point to = point - facet.corner;
    const double height = to.dot(facet.normal), second = to.dot(facet.second), third = to.dot(facet.third);
    const double first = 1 - second - third;
    // NaN is beyond nothing.
    double beyond = first < 0 ? first * first * facet.heights[0] : 0;
    if (second < 0) beyond = std::max(beyond, second * second * facet.heights[1]);
    if (third < 0) beyond = std::max(beyond, third * third * facet.heights[2]);
    return (1 - 1e-9) * (height * height + beyond);
  }
  /// What find() says of a point, given its nearest triangle.
  [[nodiscard]] Foot foot(const Point& point, int triangle, const Nearest& near) const {
    const Facet& facet = facets_[static_cast<std::size_t>(triangle)];
    const std::array<double, 4>& w = near.weights;
    const bool inside = w[1] != 0 && w[2] != 0 && w[3] != 0;
    if (!inside || !(facet.heights[0] > 0)) return foot_on_edge(point, triangle, near);
    // Along the triangle's own normal: what lies on a flat face is pushed in one direction.
    return on_its_side({triangle, {-w[1], -w[2], -w[3]}, facet.normal, facet.normal.dot(point - facet.corner)});
  }

  /// Out of the mesh at a feature of a triangle: of an edge or a corner where weights are zero. Not of unit length.
  [[nodiscard]] Point normal_at(int triangle, const Point& weights) const;

  /// Unit vector out of a triangle; zero without an area.
  [[nodiscard]] const Point& face_normal(int triangle) const { return normals_[static_cast<std::size_t>(triangle)]; }
  /// A measure of where it is: what differs in it by so much has no point that is further apart, but perhaps nearer
  /// [m].
  [[nodiscard]] double travel() const { return travel_; }
  [[nodiscard]] bool solid() const { return topology_->closed; }
  [[nodiscard]] const MeshTopology& topology() const { return *topology_; }
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] const TriangleTree& tree() const { return tree_; }
  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

 private:
  /// A triangle as its plane and the weights of its corners in it. Where it has next to no area it is its edges: the
  /// weights are NaN, and the normal is zero.
  struct Facet {
    Point corner, normal;  // the first corner, and the unit normal outwards
    Point second, third;   // the weight of a corner at p is that times p − corner
    Point heights;         // above the edges that are opposite to its corners, squared [m²]
  };

  void update(const Vertices& x);
  [[nodiscard]] const Point& corner(int triangle, std::size_t c) const {
    return points_[static_cast<std::size_t>(topology_->triangles[static_cast<std::size_t>(triangle)][c])];
  }
  [[nodiscard]] Foot foot_on_edge(const Point& point, int triangle, const Nearest& near) const;
  /// Whether the mesh is around a point, by the angle that it fills from there (Jacobson, Kavan and Sorkine-Hornung
  /// 2013, "Robust inside-outside segmentation using generalized winding numbers"). It looks at every triangle.
  [[nodiscard]] bool encloses(const Point& point) const;
  /// The same, on the other side where that is a shell's.
  [[nodiscard]] Foot on_its_side(Foot foot) const {
    if (!topology_->closed && foot.distance < 0) {
      foot.distance = -foot.distance;
      foot.normal = -foot.normal;
    }
    return foot;
  }

  std::shared_ptr<const MeshTopology> topology_;
  std::vector<Point> points_;
  std::vector<Point> normals_;  // of the triangles, unit vectors outwards; zero without an area
  std::vector<Facet> facets_;
  std::vector<Box> boxes_;
  TriangleTree tree_;
  double travel_;
};

}  // namespace drape
