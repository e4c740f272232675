#include "sim/effects/motion_keys.hpp"

#include "core/keys.hpp"

namespace drape {

void describe_motion(Keys& keys, const std::string& place, std::optional<Eigen::Vector3d>& velocity,
                     std::optional<double>& orbit_period, Eigen::Vector3d& orbit_center, Eigen::Vector3d& orbit_axis,
                     std::vector<Keyframe>& keyframes, Interpolation& interpolation) {
  keys.add("velocity", &velocity, "m/s", "Constant velocity, starting from `" + place + "`.");
  keys.add("orbit_period", &orbit_period, "s",
           "Period of a circular orbit that starts from `" + place + "`; negative reverses it.");
  keys.add("orbit_center", &orbit_center, "m", "A point on the axis of the orbit.");
  keys.add("orbit_axis", &orbit_axis, "",
           "Direction of that axis; the motion is counterclockwise as seen from its tip.");
  keys.add("keyframes", KeyframeList{{place}, &keyframes}, "s, m", "Positions of its centre over time.");
  keys.choice("interpolation", interpolation, {"linear", "smooth"},
              "Interpolation between keyframes: at constant speed, or with continuous velocity.");
}

void check_orbit(const std::optional<double>& period, const Eigen::Vector3d& axis, const ProblemSink& problem) {
  if (period && *period == 0) problem("orbit_period", "expected a time other than 0");
  if (axis.isZero(0)) problem("orbit_axis", "expected a direction, found [0, 0, 0]");
}

}  // namespace drape
