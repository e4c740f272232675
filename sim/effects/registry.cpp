#include <algorithm>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/air.hpp"
#include "drape/sim/effects/bending.hpp"
#include "drape/sim/effects/body.hpp"
#include "drape/sim/effects/damping.hpp"
#include "drape/sim/effects/effect.hpp"
#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/moving_pins.hpp"
#include "drape/sim/effects/pressure.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/effects/sphere.hpp"
#include "drape/sim/effects/strain_limit.hpp"

namespace drape {
namespace {

template <class T>
constexpr EffectType row() {
  constexpr bool repeatable = requires { requires T::repeatable; };
  return {T::name, repeatable, [] { return Effect(T{}); }};
}

/// Returns the effect's index in the registry, or the registry's size if it is not registered.
std::size_t rank(const Effect& effect) {
  const auto types = effect_types();
  return static_cast<std::size_t>(std::ranges::find(types, effect.name(), &EffectType::name) - types.begin());
}

}  // namespace

std::span<const EffectType> effect_types() {
  static constexpr EffectType types[] = {
      // clang-format off
      row<Gravity>(),
      row<Wind>(),
      row<Field>(),
      row<Air>(),
      row<Bending>(),
      row<Pressure>(),
      row<InternalDamping>(),
      row<MovingPins>(),
      row<Sphere>(),
      row<Ground>(),
      row<StrainLimit>(),
      row<Body>(),
      row<SelfCollision>(),
      row<Damping>(),
      // clang-format on
  };
  return types;
}

void Effects::add(Effect effect) {
  const std::size_t unlisted = effect_types().size(), wanted = rank(effect);
  auto place = effects_.end();
  while (place != effects_.begin() && rank(place[-1]) != unlisted && rank(place[-1]) > wanted) --place;
  effects_.insert(place, std::move(effect));
}

}  // namespace drape
