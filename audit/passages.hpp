#pragma once

#include <array>
#include <string>
#include <vector>

#include "audit/surface.hpp"

namespace drape::audit {

/// A pair of features that meet while all vertices move on straight lines in a step.
struct Passage {
  enum class Kind { vertex_triangle, edge_edge };

  Kind kind = Kind::vertex_triangle;
  Owner first_owner = Owner::cloth;   ///< of the vertex or the first edge
  Owner second_owner = Owner::cloth;  ///< of the triangle or the second edge
  std::array<int, 4> vertices = {};   ///< the vertex and the triangle's three, or the edges' two each
  double time = 0;                    ///< in [0, 1]; a moment at which they meet
  bool touch = false;                 ///< see Meeting::touch
};

/// "cloth vertex 3 meets body triangle 7 8 9 at 0.25 of the step"
std::string describe(const Passage& passage);

/// Finds all pairs of a vertex and a triangle, and of two edges, of one mesh that meet in a step; sorted by kind and
/// vertices.
///
/// Decided exactly, see meeting.hpp: no pair is missed, also none that meets twice or is apart at both ends of the
/// step. Touching counts as meeting. Pairs with a common vertex are left out. Two adjacent triangles (a, b, c) and (b,
/// a, d) that fold onto each other are still found: vertex d, which the triangle (a, b, c) does not have, goes through
/// it, or edge a–d through b–c.
/// @throws std::invalid_argument if a position is not finite, a triangle's vertex does not exist or from and to differ
/// in size
std::vector<Passage> find_passages(const SurfaceMotion& cloth);

/// Finds all pairs of a feature of the cloth and one of the body that meet in a step: cloth vertices and body
/// triangles, body vertices and cloth triangles, edges of both. Both may move.
std::vector<Passage> find_passages(const SurfaceMotion& cloth, const SurfaceMotion& body);

}  // namespace drape::audit
