#pragma once

#include "drape/sim/mesh.hpp"

namespace drape::test {

/// Makes a sphere of 8n² triangles around the origin: an octahedron with its faces divided. All fronts face outwards.
Mesh ball(int n, double radius);

/// Makes two discs of radius 1 with `rings` rings of triangles, joined along their rims; ring r has 6r vertices. The
/// upper disc faces up, the lower down. They are a lens: z = ±thickness/2·(1 − r²).
Mesh two_discs(int rings, double thickness);

/// Makes such discs of `meridians` straight lines from the middle to the rim, each in as many pieces as there are
/// rings. Vertices are the middle, then ring after ring of the upper disc without its rim, then those of the lower,
/// then the rim; each ring begins on the same meridian.
Mesh gored_discs(int meridians, int rings, double thickness);

}  // namespace drape::test
