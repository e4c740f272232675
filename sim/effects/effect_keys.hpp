#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/keys.hpp"
#include "drape/sim/effects/effect.hpp"
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

}  // namespace drape
