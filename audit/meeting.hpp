#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace drape::audit {

/// A vertex's linear path in a step: from + t (to − from) for t in [0, 1].
struct Way {
  Eigen::Vector3d from, to;
};

/// A moment at which two moving features have a common point.
struct Meeting {
  double time = 0;     ///< in [0, 1]
  bool touch = false;  ///< no proven crossing: the features touch, or come within 2⁻⁸⁰ of a step of touching
};

/// Decides exactly if a vertex and a triangle with its boundary have a common point at some t in [0, 1].
///
/// No meeting is missed: "no" is a proof. Every meeting without `touch` is proven as well; `touch` cases have measure
/// zero. Coordinates as in `exact_range`.
///
/// Method: let a, b, c point from the vertex to the corners. Then volume(t) = det(a, b, c) is a cubic, and the areas
/// a×b, b×c, c×a are quadratic. The step is bisected; on each part, the signs of Bernstein coefficients decide.
/// A part is empty in three cases: the volume has one sign; a coordinate of a, b and c has one sign; a coordinate of
/// two areas has opposite signs. It contains a meeting if the volume changes its sign and a coordinate of all three
/// areas has the same sign. Doubles with a forward error bound come first, then expansions.
std::optional<Meeting> vertex_meets_triangle(const Way& vertex, const std::array<Way, 3>& triangle);

/// Decides exactly if two edges with their ends have a common point at some t in [0, 1].
///
/// Like `vertex_meets_triangle`, with the four differences of the edges' ends and the areas spanned by an edge and an
/// end of the other.
std::optional<Meeting> edges_meet(const std::array<Way, 2>& first, const std::array<Way, 2>& second);

}  // namespace drape::audit
