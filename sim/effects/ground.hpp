#pragma once

#include <memory>

#include "sim/effects/effect.hpp"

namespace drape {

std::unique_ptr<Effect> make_ground();

}  // namespace drape
