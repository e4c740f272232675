#pragma once

#include <array>
#include <string>
#include <vector>

#include "audit/surface.hpp"

namespace drape::audit {

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
