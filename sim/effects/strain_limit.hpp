#pragma once

#include <memory>

#include "sim/effects/effect.hpp"

namespace drape {

/// Keeps every edge of the cloth from being stretched, or compressed, beyond a limit.
std::unique_ptr<Effect> make_strain_limit();

}  // namespace drape
