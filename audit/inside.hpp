#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "audit/surface.hpp"

namespace drape::audit {

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
