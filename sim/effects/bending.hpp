#pragma once

#include <memory>

#include "sim/effects/effect.hpp"

namespace drape {

/// Resistance to bending: an energy of the curvature, "cross" springs, or both.
std::unique_ptr<Effect> make_bending();

}  // namespace drape
