#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "sim/effects/effect.hpp"
#include "sim/keyframes.hpp"

namespace drape {

/// Adds the keys for the motion of an effect with these members.
/// @param place key of the start position and of the keyframes' values
void describe_motion(Keys& keys, const std::string& place, std::optional<Eigen::Vector3d>& velocity,
                     std::optional<double>& orbit_period, Eigen::Vector3d& orbit_center, Eigen::Vector3d& orbit_axis,
                     std::vector<Keyframe>& keyframes, Interpolation& interpolation);

/// Reports the problems of an orbit.
void check_orbit(const std::optional<double>& period, const Eigen::Vector3d& axis, const ProblemSink& problem);

}  // namespace drape
