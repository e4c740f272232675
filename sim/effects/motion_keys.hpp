#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "sim/effects/effect.hpp"
#include "sim/keyframes.hpp"

namespace drape {

/// Adds the keys that say how something moves as a whole, of an effect that has these members.
/// @param place the key that says where it is at the start, and what its keyframes say
void describe_motion(Keys& keys, const std::string& place, std::optional<Eigen::Vector3d>& velocity,
                     std::optional<double>& orbit_period, Eigen::Vector3d& orbit_center, Eigen::Vector3d& orbit_axis,
                     std::vector<Keyframe>& keyframes, Interpolation& interpolation);

/// Says what is wrong with an orbit.
void check_orbit(const std::optional<double>& period, const Eigen::Vector3d& axis, const ProblemSink& problem);

}  // namespace drape
