#pragma once

#include "drape/sim/mesh.hpp"

namespace drape::test {

/// Makes a sphere of 8n² triangles around the origin: an octahedron with its faces divided. All fronts face outwards.
Mesh ball(int n, double radius);

/// Makes two discs of radius 1 with `rings` rings of triangles, joined along their rims; ring r has 6r vertices. The
/// upper disc faces up, the lower down. They are a lens: z = ±thickness/2·(1 − r²).
Mesh two_discs(int rings, double thickness);

}  // namespace drape::test
