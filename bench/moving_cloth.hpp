#pragma once

#include "sim/cloth.hpp"

namespace drape {

/// Makes the homework's cloth with k = 180 at rest, before its release.
Cloth make_resting_cloth(int cells);

/// Makes the homework's cloth with k = 180 one second after its release: folded, stretched and moving, so that no
/// branch of a solver is idle. Its state is computed once by the textbook on 20×20 cells and interpolated onto the
/// finer grid, so every size has the same motion.
/// @param cells along each side, a multiple of 20
Cloth make_moving_cloth(int cells);

}  // namespace drape
