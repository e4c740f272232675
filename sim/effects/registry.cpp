#include "sim/effects/effect.hpp"
#include "sim/effects/gravity.hpp"

#ifndef DRAPE_ONLY_GRAVITY
#include "sim/effects/air.hpp"
#include "sim/effects/bending.hpp"
#include "sim/effects/damping.hpp"
#include "sim/effects/ground.hpp"
#include "sim/effects/moving_pins.hpp"
#include "sim/effects/self_collision.hpp"
#include "sim/effects/sphere.hpp"
#include "sim/effects/strain_limit.hpp"
#include "sim/effects/wind.hpp"
#endif

namespace drape {

std::span<const EffectType> effect_types() {
  static constexpr EffectType types[] = {
      {"gravity", false, make_gravity},
#ifndef DRAPE_ONLY_GRAVITY
      {"wind", false, make_wind},
      {"air", false, make_air},
      {"bending", false, make_bending},
      {"moving_pins", true, make_moving_pins},
      {"sphere", true, make_sphere},
      {"ground", true, make_ground},
      {"strain_limit", false, make_strain_limit},
      {"self_collision", false, make_self_collision},
      {"damping", false, make_damping},
#endif
  };
  return types;
}

}  // namespace drape
