#pragma once

#include <memory>

#include "sim/effects/effect.hpp"

namespace drape {

/// Keeps the cloth from going through itself.
std::unique_ptr<Effect> make_self_collision();

}  // namespace drape
