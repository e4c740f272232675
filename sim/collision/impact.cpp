#include "sim/collision/impact.hpp"

#include <algorithm>
#include <cmath>

namespace drape {
namespace {

// Of the step that would close the gap at full speed: less, so that rounding never takes it too far.
constexpr double stride = 0.9;
// Features that slide along each other at a small distance need many steps. Then they count as colliding.
constexpr int max_steps = 200;

/// How fast the distance can change at most.
double largest_speed(Feature feature, const FourPoints& move) {
  const double a = move[0].norm(), b = move[1].norm(), c = move[2].norm(), d = move[3].norm();
  return feature == Feature::vertex_triangle ? a + std::max({b, c, d}) : std::max(a, b) + std::max(c, d);
}

}  // namespace

std::optional<double> time_of_impact(Feature feature, FourPoints p, FourPoints move) {
  // What all four do together changes no distance.
  const Point mean = (move[0] + move[1] + move[2] + move[3]) / 4;
  for (Point& m : move) m -= mean;
  const double speed = largest_speed(feature, move);
  double distance = std::sqrt(nearest(feature, p).squared);
  const double gap = kept_gap * distance;
  if (!(distance > 0) || speed <= distance - gap) return std::nullopt;
  double time = 0;
  for (int step = 0; step < max_steps; ++step) {
    const double forward = stride * distance / speed;
    if (time + forward > 1) return std::nullopt;
    time += forward;
    for (std::size_t i = 0; i < 4; ++i) p[i] += forward * move[i];
    distance = std::sqrt(nearest(feature, p).squared);
    if (distance <= gap) return time;
  }
  return time;
}

}  // namespace drape
