#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "drape/sim/mesh.hpp"

namespace drape::audit {

/// Triangles and unique edges of a mesh. Made once for all steps of a motion.
struct Topology {
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
  std::vector<Edge> sewn = {};  ///< vertices that seams tie together, which count as common vertices; sorted
};

/// Makes the topology of triangles.
/// @param sewn see Topology, sorted
/// @throws std::invalid_argument if a triangle has a negative or a repeated vertex
Topology make_topology(std::vector<Triangle> triangles, std::vector<Edge> sewn = {});

/// Returns the pairs of vertices that seams tie together, each in ascending order; sorted.
std::vector<Edge> sewn_vertices(const std::vector<Seam>& seams);

/// A mesh at one moment. Refers to its data.
struct Surface {
  const Topology& topology;
  const Vertices& x;  ///< [m]
};

/// A mesh in one step: all vertices move on straight lines, x(t) = from + t (to − from) for t in [0, 1].
struct SurfaceMotion {
  const Topology& topology;
  const Vertices& from;  ///< [m]
  const Vertices& to;    ///< [m]
};

/// The mesh that owns a feature.
enum class Owner { cloth, body };

/// Returns for example "cloth vertex 3", "body edge 3 4", "cloth triangle 3 4 5".
std::string describe(Owner owner, std::vector<int> vertices);

/// An edge that intersects a triangle at one moment.
struct Crossing {
  Owner edge_owner = Owner::cloth;
  Edge edge = {};
  Owner triangle_owner = Owner::cloth;
  Triangle triangle = {};

  bool operator==(const Crossing&) const = default;
};

/// Returns for example "cloth edge 3 4 goes through body triangle 7 8 9".
std::string describe(const Crossing& crossing);

/// Finds all edges of a mesh that intersect its triangles, sorted.
///
/// An edge intersects a triangle if its ends lie strictly on both sides of the triangle's plane, and the closed
/// triangle contains a point of the edge. Signs are exact. A surface with a vertex exactly on a triangle crosses it if
/// its triangles at that vertex cross it wherever they are displaced a little; otherwise it only touches. The edges of
/// one fixed displacement are then returned. find_passages with from = to finds touching features.
///
/// Pairs with a common vertex are skipped. No intersection is lost: two triangles with one common vertex meet in a line
/// from that vertex. The line ends at an edge of one triangle, in general the edge opposite to the vertex. Two
/// triangles with a common edge meet only there unless they are coplanar.
/// @throws std::invalid_argument if a position is non-finite or a triangle's vertex does not exist
std::vector<Crossing> find_crossings(const Surface& cloth);

/// Finds all edges of the cloth that intersect triangles of the body, and vice versa, sorted.
std::vector<Crossing> find_crossings(const Surface& cloth, const Surface& body);

/// Sorts like find_crossings: by owners, edge and triangle. Removes duplicates.
void sort(std::vector<Crossing>& crossings);

/// Returns true if one edge intersects one triangle, see find_crossings. An edge that ends in the plane does not.
bool goes_through(const std::array<Eigen::Vector3d, 2>& edge, const std::array<Eigen::Vector3d, 3>& triangle);

/// A cloth vertex inside an obstacle.
struct Inside {
  int vertex = 0;
  double depth = 0;  ///< distance to the nearest point of the obstacle's triangles or surface [m], positive
};

/// Returns for example "cloth vertex 3 is 12 mm deep inside".
std::string describe(const Inside& inside);

/// Returns true if the mesh encloses space: each edge occurs in both directions equally often among its triangles.
bool is_closed(const std::vector<Triangle>& triangles);

/// Finds the vertices inside a closed mesh, deepest first.
///
/// A vertex is inside if the mesh winds around it, so overlapping parts count as one solid. The winding number is
/// exact: the sum of a ray's signed crossings with the triangles. A vertex on the surface is outside. Depths are
/// rounded.
/// @throws std::invalid_argument if the body is not closed, a position is non-finite or a triangle's vertex does not
/// exist
std::vector<Inside> find_inside(const Vertices& cloth, const Surface& body);

/// Finds the vertices inside a sphere, deepest first.
/// @param radius [m]
std::vector<Inside> find_inside_sphere(const Vertices& cloth, const Eigen::Vector3d& center, double radius);

/// Finds the vertices behind a plane, such as those under a ground, deepest first.
/// @param normal unit vector out of the solid
std::vector<Inside> find_behind_plane(const Vertices& cloth, const Eigen::Vector3d& point,
                                      const Eigen::Vector3d& normal);

}  // namespace drape::audit
