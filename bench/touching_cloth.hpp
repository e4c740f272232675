#pragma once

#include "sim/cloth.hpp"
#include "sim/effects/body.hpp"

namespace drape {

/// Makes the cloth of make_moving_cloth at rest, folded into four layers 12 mm apart: with self-collision of that
/// thickness it has as many contacts as possible.
Cloth make_folded_cloth(int cells);

/// Makes a cushion of 10 000 triangles under the whole cloth.
Body make_cushion();

/// Makes the cloth at rest on the cushion.
Cloth make_lying_cloth(int cells);

}  // namespace drape
