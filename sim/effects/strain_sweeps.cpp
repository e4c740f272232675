// Steps of a sweep of StrainFilter.

#include <algorithm>
#include <cmath>

#include "sim/effects/strain_filter.hpp"

namespace drape {
namespace {

constexpr int rings = 3, most_passes = 8;  // for settle()
// Cosine of 25°, the largest turn of a spring in a step. Beyond it the spring is pulled along its final direction.
constexpr double least_cosine = 0.9;
// With pins, the same holds for a spring that its impulse alone would shorten by more than this fraction of its length.
// Consider crossing strings of vertices of mass m, l apart, each pulling with p/h². Vertices swing across them at up to
// ω² = Σ 4 p/(h² m l); over the four strings of a grid this is 6.8 p w/(h² l) with w = 2/m. Pulls along initial
// directions treat this motion explicitly: it grows from ω h = 2 on, at p w = 0.59 l, and is hardly damped near that.
constexpr double most_pull = 0.25;

}  // namespace

/// Updates the impulse of every active spring, even entries first. Consecutive springs of a string then do not stall
/// each other in the processor's pipeline.
void StrainFilter::relax_all(bool early) {
  for (const Index parity : {0U, 1U}) {
    for (const Index k : active_) {
      if (k % 2 == parity) relax(limited_[k], early);
    }
  }
}

/// Updates the impulse of a spring.
void StrainFilter::relax(Limited& s, bool early) {
  const Eigen::Vector3d end = end_of(s);
  const double squared = end.squaredNorm(), along = end.dot(s.direction);
  s.straight = s.straight && early && along >= 0 && along * along >= least_cosine * least_cosine * squared &&
               (free_ || std::abs(s.push) * s.weight <= most_pull * s.longest);
  if (s.straight) {
    const double across = std::max(0.0, squared - along * along);
    const double most = std::sqrt(std::max(0.0, s.longest * s.longest - across));
    const double least = s.shortest > 0 ? std::sqrt(std::max(0.0, s.shortest * s.shortest - across)) : 0;
    const double length = along - s.weight * s.impulse.dot(s.direction);  // without its own impulse
    give(s, (std::clamp(length, least, most) - length) / s.weight);
    return;
  }
  const Eigen::Vector3d free = end - s.weight * s.impulse;
  const double length = free.norm();
  if (length > 0) s.direction = free / length;
  give(s, (std::clamp(length, s.shortest, s.longest) - length) / s.weight);
}

/// Sweeps over the unconverged springs and their neighbours until they hold.
void StrainFilter::settle(bool early) {
  for (const Index k : restless_) limited_[k].stage = Stage::unconverged;
  for (Index ring = 0, inner = 0; ring < rings; ++ring) {
    for (const Index outer = restless_.size(); inner < outer; ++inner) {
      for (const int end : {limited_[restless_[inner]].i, limited_[restless_[inner]].j}) {
        for (const Index other : springs_at_[Index(end)]) {
          if (limited_[other].stage != Stage::active) continue;
          limited_[other].stage = Stage::unconverged;
          restless_.push_back(other);
        }
      }
    }
  }
  const auto hold = [this](Index k) { return holds(limited_[k], end_of(limited_[k])); };
  for (int pass = 0; pass < most_passes; ++pass) {
    for (const Index k : restless_) relax(limited_[k], early);
    if (std::ranges::all_of(restless_, hold)) break;
  }
  for (const Index k : restless_) limited_[k].stage = Stage::active;
}

/// Balances each string of active springs that pull.
void StrainFilter::pull_strings() {
  Index first = 0;
  for (Index k = 1; k <= active_.size(); ++k) {
    const bool goes_on = k < active_.size() && active_[k] == active_[k - 1] + 1 && limited_[active_[k]].joined;
    if (goes_on) continue;
    if (k - first > 1) pull_string(first, k - first);
    first = k;
  }
}

/// @param first, count range in active_
void StrainFilter::pull_string(Index first, Index count) {
  string_.clear();
  for (Index k = first; k < first + count; ++k) {
    const Limited& s = limited_[active_[k]];
    const Eigen::Vector3d end = end_of(s);
    const double along = s.direction.dot(end);
    // A spring with a fixed direction keeps the length that its transverse part leaves.
    const double most =
        !s.straight ? s.longest : std::sqrt(std::max(0.0, s.longest * s.longest - end.squaredNorm() + along * along));
    const double coupling = string_.empty() ? 0 : weight_[s.i] * s.direction.dot(string_.back().along);
    string_.push_back({.along = s.direction,
                       .weight = s.weight,
                       .coupling = coupling,
                       .excess = along - most,
                       .pull = std::max(0.0, -s.push)});
  }
  balance(string_);
  for (Index k = 0; k < count; ++k) {
    const Tension& t = string_[k];
    if (t.more != 0) give(limited_[active_[first + k]], -(t.pull + t.more));
  }
}

/// Returns true if a spring with this end vector is within its limits, and at the limit where it pulls or pushes,
/// within the tolerance.
bool StrainFilter::holds(const Limited& s, const Eigen::Vector3d& end) const {
  const double most = (1 + limits_.tolerance) * (s.push > 0 ? s.shortest : s.longest);
  const double least = (1 - limits_.tolerance) * (s.push < 0 ? s.longest : s.shortest);
  const double squared = end.squaredNorm();
  return squared <= most * most && squared >= least * least;
}

/// Returns φ and collects the springs that do not hold.
double StrainFilter::assess() {
  double value = 0;
  restless_.clear();
  for (const Index k : active_) {
    const Limited& s = limited_[k];
    const Eigen::Vector3d way = change_[Index(s.i)] - change_[Index(s.j)];
    if (!holds(s, s.end + way)) restless_.push_back(k);
    // ‖δ‖²_M is the work of the impulses along δ.
    value += s.impulse.dot(s.end + 0.5 * way) - s.push * (s.push > 0 ? s.shortest : s.longest);
  }
  return value;
}

/// Extrapolates the impulses of a sweep along their last change. If the last extrapolation raised φ to this value,
/// restores the impulses of the previous sweep instead.
void StrainFilter::go_on(double value) {
  if (value > last_value_ && ahead_ > 0) return go_back();
  last_value_ = value;
  const double next = (1 + std::sqrt(1 + 4 * pace_ * pace_)) / 2;
  ahead_ = (pace_ - 1) / next;
  pace_ = next;
  const auto extrapolate = [part = ahead_](Eigen::Vector3d& now, Eigen::Vector3d& last) {
    const Eigen::Vector3d further = now + part * (now - last);
    last = now;
    now = further;
  };
  for (const Index k : active_) extrapolate(limited_[k].impulse, limited_[k].last);
  for (const int i : moved_) extrapolate(change_[Index(i)], last_change_[Index(i)]);
}

void StrainFilter::go_back() {
  pace_ = 1;
  ahead_ = 0;
  for (const Index k : active_) limited_[k].impulse = limited_[k].last;
  for (const int i : moved_) change_[Index(i)] = last_change_[Index(i)];
}

}  // namespace drape
