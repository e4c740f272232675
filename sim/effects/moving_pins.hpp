#pragma once

#include <memory>

#include "sim/effects/effect.hpp"

namespace drape {

std::unique_ptr<Effect> make_moving_pins();

}  // namespace drape
