#pragma once

#include <limits>
#include <optional>

#include "sim/collision/distance.hpp"

namespace drape {

/// Fraction of their initial distance at which two features count as colliding.
inline constexpr double kept_gap = 0.1;

/// Returns an upper bound on the change of two features' distance when their points move by `move` [m]. The mean motion
/// of all four does not count.
double largest_change(Feature feature, const FourPoints& move);

/// Returns the first time at which two features, moving as p + t·move for t in [0, 1], approach to about `kept_gap`
/// times their distance at t = 0. They are never nearer before. Returns nothing if they stay further apart.
/// Detects every collision for any motion: it advances by steps too short for a contact within them (Li, Kaufman and
/// Jiang 2021, "Codimensional incremental potential contact", section 5.2). Unlike with roots of a cubic, coplanar,
/// parallel and degenerate features need no special cases. Features that touch at t = 0 do not collide, as their side
/// is undefined.
/// @param widest upper limit of the gap [m]
std::optional<double> time_of_impact(Feature feature, FourPoints p, FourPoints move,
                                     double widest = std::numeric_limits<double>::infinity());

/// Returns true if two moving features come within 0.8 of a distance [m]; false if they stay beyond the distance. In
/// between either may be returned. Uses the method of time_of_impact().
bool comes_within(Feature feature, FourPoints p, const FourPoints& move, double distance);

}  // namespace drape
