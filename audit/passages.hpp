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
  bool touch = false;  ///< no proven crossing: the features touch, or 80 bisections of the step do not decide
};

/// Tests exactly if a vertex and a closed triangle meet at some t in [0, 1] (continuous collision detection).
///
/// An empty result proves that they do not meet. A result without `touch` is a proven crossing. Results with `touch`
/// have measure zero. Coordinates as in `exact_range`.
///
/// Method: let a, b, c point from the vertex to the corners. Then volume(t) = det(a, b, c) is a cubic, and the areas
/// a×b, b×c, c×a are quadratic. The step is bisected; on each part, the signs of Bernstein coefficients decide. A part
/// has no meeting in three cases:
/// - the volume has one sign;
/// - a coordinate has the same sign in a, b and c;
/// - a coordinate has opposite signs in two areas.
///
/// A part has a meeting if the volume changes its sign and a coordinate has the same sign in all three areas. Signs are
/// computed in doubles with a forward error bound, and in floating-point expansions where that fails.
std::optional<Meeting> vertex_meets_triangle(const Way& vertex, const std::array<Way, 3>& triangle);

/// Tests exactly if two closed edges meet at some t in [0, 1].
///
/// The method is that of `vertex_meets_triangle`, with the four vectors between the edges' ends. An edge and an end of
/// the other span each area.
std::optional<Meeting> edges_meet(const std::array<Way, 2>& first, const std::array<Way, 2>& second);

/// Two features that meet while all vertices move on straight lines in a step.
struct Passage {
  enum class Kind { vertex_triangle, edge_edge };

  Kind kind = Kind::vertex_triangle;
  Owner first_owner = Owner::cloth;   ///< owner of the vertex or the first edge
  Owner second_owner = Owner::cloth;  ///< owner of the triangle or the second edge
  std::array<int, 4> vertices = {};   ///< the vertex and the triangle's three, or two of each edge
  double time = 0;                    ///< a time at which they meet, in [0, 1]
  bool touch = false;                 ///< the features touch, but do not pass through each other, see Touches
};

class Touches;

/// Returns for example "cloth vertex 3 meets body triangle 7 8 9 at 0.25 of the step".
std::string describe(const Passage& passage);

/// Finds all vertex–triangle and edge–edge pairs of one mesh that meet in a step, sorted by kind and vertices.
///
/// Decisions are exact, see vertex_meets_triangle(): no pair is missed, including pairs that meet twice or only within
/// the step. Touching counts as meeting. Pairs with a common vertex are skipped. Two adjacent triangles (a, b, c) and
/// (b, a, d) that fold onto each other are still found. Vertex d goes through the triangle (a, b, c), or edge a–d
/// through b–c.
/// @param touches memory of the steps before, for surfaces that pass through each other in several steps
/// @throws std::invalid_argument if a position is non-finite, a triangle's vertex does not exist or from and to differ
/// in size
std::vector<Passage> find_passages(const SurfaceMotion& cloth, Touches* touches = nullptr);

/// Finds all pairs of a cloth feature and a body feature that meet in a step: cloth vertices and body triangles, body
/// vertices and cloth triangles, edges of both. Both may move.
std::vector<Passage> find_passages(const SurfaceMotion& cloth, const SurfaceMotion& body, Touches* touches = nullptr);

}  // namespace drape::audit
