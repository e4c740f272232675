// What a sweep of a StrainFilter does.

#include <algorithm>
#include <cmath>

#include "sim/effects/strain_filter.hpp"

namespace drape {
namespace {

constexpr int rings = 3, most_passes = 8;  // of settling the last springs
// A spring that turns in one step by more than 25°, by the cosine of this, is pulled along where it ends.
constexpr double least_cosine = 0.9;
// In a cloth with pins so is one that its impulse alone would shorten by more than this part of its length. Where
// strings of vertices of mass m, l apart, cross and pull by p/h² each, vertices swing across by up to ω² = Σ 4 p/(h² m
// l), over the four strings of a grid 6.8 p w/(h² l) with w = 2/m. Pulls along where springs start are explicit in
// that: it swings up from ω h = 2 on, at p w = 0.59 l, and hardly dies down near it.
constexpr double most_pull = 0.25;

}  // namespace

/// Gives every active spring the impulse it needs, every other one first: two that follow one another in a string do
/// not then wait for one another in the processor.
void StrainFilter::relax_all(bool early) {
  for (const Index parity : {0U, 1U}) {
    for (const Index k : active_) {
      if (k % 2 == parity) relax(limited_[k], early);
    }
  }
}

/// Gives a spring the impulse it needs now.
void StrainFilter::relax(Limited& s, bool early) {
  const Eigen::Vector3d end = end_of(s);
  const double squared = end.squaredNorm(), along = end.dot(s.direction);
  s.straight = s.straight && early && along >= 0 && along * along >= least_cosine * least_cosine * squared &&
               (free_ || std::abs(s.push) * s.weight <= most_pull * s.longest);
  if (s.straight) {
    const double across = std::max(0.0, squared - along * along);
    const double most = std::sqrt(std::max(0.0, s.longest * s.longest - across));
    const double least = s.shortest > 0 ? std::sqrt(std::max(0.0, s.shortest * s.shortest - across)) : 0;
    const double length = along - s.weight * s.impulse.dot(s.direction);  // without it
    give(s, (std::clamp(length, least, most) - length) / s.weight);
    return;
  }
  const Eigen::Vector3d free = end - s.weight * s.impulse;
  const double length = free.norm();
  if (length > 0) s.direction = free / length;
  give(s, (std::clamp(length, s.shortest, s.longest) - length) / s.weight);
}

/// Sweeps over the springs that are still beyond the tolerance, and those around them, until they hold.
void StrainFilter::settle(bool early) {
  for (const Index k : restless_) limited_[k].stage = Stage::restless;
  for (Index ring = 0, inner = 0; ring < rings; ++ring) {
    for (const Index outer = restless_.size(); inner < outer; ++inner) {
      for (const int end : {limited_[restless_[inner]].i, limited_[restless_[inner]].j}) {
        for (const Index other : springs_at_[Index(end)]) {
          if (limited_[other].stage != Stage::active) continue;
          limited_[other].stage = Stage::restless;
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

/// @param first, count of active_
void StrainFilter::pull_string(Index first, Index count) {
  string_.clear();
  for (Index k = first; k < first + count; ++k) {
    const Limited& s = limited_[active_[k]];
    const Eigen::Vector3d end = end_of(s);
    const double along = s.direction.dot(end);
    // One that is kept straight has the part of its length that is left beside what is across.
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

/// Whether a spring with this end is within its limits, and where it pulls or pushes at that limit, to the tolerance.
bool StrainFilter::holds(const Limited& s, const Eigen::Vector3d& end) const {
  const double most = (1 + limits_.tolerance) * (s.push > 0 ? s.shortest : s.longest);
  const double least = (1 - limits_.tolerance) * (s.push < 0 ? s.longest : s.shortest);
  const double squared = end.squaredNorm();
  return squared <= most * most && squared >= least * least;
}

/// Returns φ, and finds what does not hold.
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

/// Goes on from the impulses of a sweep in the direction of what it has changed, or, where that has raised φ to this
/// value, back to those a sweep ago.
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
