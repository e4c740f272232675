#pragma once

#include <limits>
#include <optional>

#include "sim/collision/distance.hpp"

namespace drape {

/// The part of the distance that two features had before, down to which they may come before they count as colliding.
inline constexpr double kept_gap = 0.1;

/// How far the distance of two features can change while their points move by `move` [m]: what all four do together
/// does not count.
double largest_change(Feature feature, const FourPoints& move);

/// When two features that move on straight lines, p + t·move for t in [0, 1], come as near as `kept_gap` times their
/// distance at t = 0: a time at which they are about that near and before which they were never nearer, or nothing if
/// they stay further apart. Never misses a collision, whatever the motion: it goes from time to time by steps that are
/// too short for anything to happen within them (Li, Kaufman and Jiang 2021, "Codimensional incremental potential
/// contact", section 5.2), so coplanar, parallel and degenerate features need no cases of their own, as they do where
/// the times are roots of a cubic. Features that touch at t = 0 do not collide: there is no side to keep them on.
/// @param widest if given, what they may come near to is no more than this [m]
std::optional<double> time_of_impact(Feature feature, FourPoints p, FourPoints move,
                                     double widest = std::numeric_limits<double>::infinity());

/// Whether two features that move so come nearer than a distance [m], or almost: not if they stay further apart, and
/// always if they come nearer than 0.8 of it. Found in the same way.
bool comes_within(Feature feature, FourPoints p, const FourPoints& move, double distance);

}  // namespace drape
