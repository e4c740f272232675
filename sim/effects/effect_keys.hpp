#pragma once

// Keys that several effects have, with their checks.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/keys.hpp"
#include "drape/sim/cloth.hpp"
#include "drape/sim/effects/effect.hpp"
#include "drape/sim/settings.hpp"
#include "drape/sim/tracks.hpp"

namespace drape {

/// Adds the keys for the motion of an effect with these members.
/// @param place key of the start position and of the keyframes' values
void describe_motion(Keys& keys, const std::string& place, std::optional<Eigen::Vector3d>& velocity,
                     std::optional<double>& orbit_period, Eigen::Vector3d& orbit_center, Eigen::Vector3d& orbit_axis,
                     std::vector<Keyframe>& keyframes, Interpolation& interpolation);

/// Reports the problems of an orbit.
void check_orbit(const std::optional<double>& period, const Eigen::Vector3d& axis, const ProblemSink& problem);

/// Adds the key `friction` of anything that the cloth touches, and advice for keys of former versions.
void describe_friction(Keys& keys, double& friction);

/// Adds the key `allow_overlap`.
void describe_overlap(Keys& keys, bool& allow_overlap);

/// Adds the keys of an obstacle: `friction` and `restitution`.
/// @param restitution target of that key, a number or an optional one
void describe_obstacle(Keys& keys, double& friction, Key::Target restitution);

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
