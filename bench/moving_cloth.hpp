#pragma once

#include "sim/cloth.hpp"

namespace drape {

/// The homework's cloth with k = 180 before it is let go.
Cloth make_resting_cloth(int cells);

/// The homework's cloth with k = 180 as it is one second after it was let go: folded, stretched and moving, so that no
/// branch of a solver is idle. Its start positions and velocities are those of 20×20 cells, computed once by the
/// textbook and interpolated onto the finer grid, so every size is the same motion.
/// @param cells along each side, a multiple of 20
Cloth make_moving_cloth(int cells);

}  // namespace drape
