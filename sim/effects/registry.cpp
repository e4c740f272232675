#include "sim/effects/bending.hpp"
#include "sim/effects/damping.hpp"
#include "sim/effects/effect.hpp"
#include "sim/effects/gravity.hpp"
#include "sim/effects/self_collision.hpp"
#include "sim/effects/sphere.hpp"
#include "sim/effects/strain_limit.hpp"
#include "sim/effects/wind.hpp"

namespace drape {

std::span<const EffectType> effect_types() {
  static constexpr EffectType types[] = {
      {"gravity", false, make_gravity},
      {"wind", false, make_wind},
      {"bending", false, make_bending},
      {"sphere", true, make_sphere},
      {"strain_limit", false, make_strain_limit},
      {"self_collision", false, make_self_collision},
      {"damping", false, make_damping},
  };
  return types;
}

}  // namespace drape
