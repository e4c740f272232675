#pragma once

#include <functional>
#include <string>

#include "drape/sim/cloth.hpp"
#include "drape/sim/effects/effect.hpp"
#include "drape/sim/settings.hpp"

namespace drape {

/// Adds the key `cloth` of an effect that can act on one of several cloths.
void describe_cloth(Keys& keys, std::string& name);

/// Reports a name that no cloth has. Empty names stand for all cloths.
void check_cloth(const std::string& name, const SimulationSettings& settings, const ProblemSink& problem);

/// Reports an earlier effect of the same type that acts on the same cloth.
template <class T>
void check_acts_alone(const T& effect, const SimulationSettings& settings, const ProblemSink& problem) {
  for (const Effect& one : settings.effects) {
    const T* other = one.as<T>();
    if (other == &effect) return;
    if (other == nullptr || !(other->cloth.empty() || effect.cloth.empty() || other->cloth == effect.cloth)) continue;
    const std::string& name = effect.cloth.empty() ? other->cloth : effect.cloth;
    problem("cloth", "another table [effects." + std::string(T::name) + "] already acts on " +
                         (name.empty() ? "every cloth" : "'" + name + "'"));
    return;
  }
}

/// Calls use(cloth, piece) with every cloth that an effect acts on: all pieces, or the one with this name. A cloth
/// without pieces is passed as it is, with piece −1.
void for_cloths(const Cloth& cloth, const std::string& name, const std::function<void(const Cloth&, int)>& use);

}  // namespace drape
