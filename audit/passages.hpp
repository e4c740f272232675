#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "audit/crossings.hpp"

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

/// Two features that meet while all vertices move on straight lines in a step.
struct Passage {
  enum class Kind { vertex_triangle, edge_edge };

  Kind kind = Kind::vertex_triangle;
  Owner first_owner = Owner::cloth;   ///< owner of the vertex or the first edge
  Owner second_owner = Owner::cloth;  ///< owner of the triangle or the second edge
  std::array<int, 4> vertices = {};   ///< the vertex and the triangle's three, or two of each edge
  double time = 0;                    ///< a time at which they meet, in [0, 1]
  bool touch = false;                 ///< see Meeting::touch
};

/// Returns for example "cloth vertex 3 meets body triangle 7 8 9 at 0.25 of the step".
std::string describe(const Passage& passage);

/// Finds all pairs of a vertex and a triangle, and of two edges, of one mesh that meet in a step; sorted by kind and
/// vertices.
///
/// Decisions are exact, see meeting.hpp: no pair is missed, including pairs that meet twice or only within the step.
/// Touching counts as meeting. Pairs with a common vertex are skipped. Two adjacent triangles (a, b, c) and (b, a, d)
/// that fold onto each other are still found: vertex d goes through the triangle (a, b, c), or edge a–d through b–c.
/// @throws std::invalid_argument if a position is non-finite, a triangle's vertex does not exist or from and to differ
/// in size
std::vector<Passage> find_passages(const SurfaceMotion& cloth);

/// Finds all pairs of a cloth feature and a body feature that meet in a step: cloth vertices and body triangles, body
/// vertices and cloth triangles, edges of both. Both may move.
std::vector<Passage> find_passages(const SurfaceMotion& cloth, const SurfaceMotion& body);

}  // namespace drape::audit
