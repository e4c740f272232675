#pragma once

#include "drape/sim/cloth.hpp"
#include "drape/sim/effects/body.hpp"

namespace drape {

/// Makes the homework's cloth with k = 180 at rest, before its release.
Cloth make_resting_cloth(int cells);

/// Makes the homework's cloth with k = 180 one second after its release: folded, stretched and moving, so that no
/// branch of a solver is idle. Its state is computed once by the textbook on 20×20 cells and interpolated onto the
/// finer grid, so every size has the same motion.
/// @param cells along each side, a multiple of 20
Cloth make_moving_cloth(int cells);

/// Makes the cloth of make_moving_cloth at rest, folded into four layers 12 mm apart: with self-collision of that
/// thickness it has as many contacts as possible.
Cloth make_folded_cloth(int cells);

/// Makes a pillow at rest: two such cloths that share their border.
Cloth make_pillow(int cells);

/// Makes the cloth at rest, cut in two along its middle and sewn together there.
Cloth make_sewn_cloth(int cells);

/// Makes a cushion of 10 000 triangles under the whole cloth.
Body make_cushion();

/// Makes the cloth at rest on the cushion.
Cloth make_lying_cloth(int cells);

}  // namespace drape
