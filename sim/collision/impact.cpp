#include "sim/collision/impact.hpp"

#include <algorithm>
#include <cmath>

namespace drape {
namespace {

// Multiple of the gap at which features count as colliding, as the gap is only approached.
constexpr double near_enough = 1.2;
// Features that touch up to rounding need many steps. Beyond this they count as colliding.
constexpr int max_steps = 200;

Point mean(const FourPoints& p) { return (p[0] + p[1] + p[2] + p[3]) / 4; }

}  // namespace

double largest_change(Feature feature, const FourPoints& move) {
  const Point together = mean(move);
  const double a = (move[0] - together).norm(), b = (move[1] - together).norm();
  const double c = (move[2] - together).norm(), d = (move[3] - together).norm();
  return feature == Feature::vertex_triangle ? a + std::max({b, c, d}) : std::max(a, b) + std::max(c, d);
}

std::optional<double> time_of_impact(Feature feature, FourPoints p, FourPoints move, double widest) {
  const double speed = largest_change(feature, move);
  double distance = std::sqrt(nearest(feature, p).squared);
  const double gap = std::min(kept_gap * distance, widest);
  if (!(distance > 0) || speed <= distance - gap) return std::nullopt;
  const Point together = mean(move);
  for (Point& m : move) m -= together;
  double time = 0;
  for (int step = 0; step < max_steps; ++step) {
    const double forward = (distance - gap) / speed;
    if (time + forward > 1) return std::nullopt;
    time += forward;
    for (std::size_t i = 0; i < 4; ++i) p[i] += forward * move[i];
    const Nearest now = nearest(feature, p);
    distance = std::sqrt(now.squared);
    if (distance <= near_enough * gap) return time;
    // Features that slide along each other come no nearer on the rest of their path.
    FourPoints to = p;
    for (std::size_t i = 0; i < 4; ++i) to[i] += (1 - time) * move[i];
    if (kept_apart(feature, now.difference(p), p, to, near_enough * gap)) return std::nullopt;
  }
  return time;
}

bool comes_within(Feature feature, FourPoints p, const FourPoints& move, double distance) {
  const double speed = largest_change(feature, move), least = 0.8 * distance;
  double time = 0;
  for (int step = 0; step < max_steps; ++step) {
    const double apart = std::sqrt(nearest(feature, p).squared);
    if (apart <= distance) return true;
    const double forward = (apart - least) / speed;
    if (!(time + forward <= 1)) return false;
    time += forward;
    for (std::size_t i = 0; i < 4; ++i) p[i] += forward * move[i];
  }
  return false;
}

}  // namespace drape
