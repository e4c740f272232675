#pragma once

#include "sim/cloth.hpp"
#include "sim/effects/body.hpp"

namespace drape {

/// The cloth of make_moving_cloth at rest, laid down in four layers 12 mm apart: with self-collision of that thickness
/// as many contacts as there can be.
Cloth make_folded_cloth(int cells);

/// A cushion under all of that cloth, of 10 000 triangles.
Body make_cushion();

/// The same cloth at rest on the cushion.
Cloth make_lying_cloth(int cells);

}  // namespace drape
