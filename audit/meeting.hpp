#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace drape::audit {

/// A vertex's straight way in a step: from + t (to − from) for t in [0, 1].
struct Way {
  Eigen::Vector3d from, to;
};

/// A moment at which two features of moving meshes have a common point.
struct Meeting {
  double time = 0;     ///< in [0, 1]
  bool touch = false;  ///< Met without a proven crossing: they touch, or come within 2⁻⁸⁰ of a step of touching.
};

/// Decides exactly whether a vertex and a triangle, its border included, have a common point at some t in [0, 1].
///
/// No meeting is missed: "no" is a proof. Every meeting that is no `touch` is proven as well; a `touch` is a set of
/// measure zero. Coordinates as in `exact_range`.
///
/// Method: with a, b, c from the vertex to the corners, volume(t) = det(a, b, c) is a cubic, and the coordinates of
/// a×b, b×c, c×a are quadratics. The step is bisected; on each part, the signs of their Bernstein coefficients decide.
/// A part is empty where the volume has one sign, where a coordinate of a, b and c has one sign, or where a coordinate
/// of two of the areas has opposite signs. It holds a meeting where the volume changes its sign and a coordinate of all
/// three areas has the same sign. Doubles with a forward error bound come first, then expansions.
std::optional<Meeting> vertex_meets_triangle(const Way& vertex, const std::array<Way, 3>& triangle);

/// Decides exactly whether two edges, their ends included, have a common point at some t in [0, 1].
///
/// As `vertex_meets_triangle`, with the four differences of the edges' ends and the areas of an edge and an end of the
/// other.
std::optional<Meeting> edges_meet(const std::array<Way, 2>& first, const std::array<Way, 2>& second);

}  // namespace drape::audit
