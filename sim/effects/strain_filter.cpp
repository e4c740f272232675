#include "sim/effects/strain_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drape {
namespace {

constexpr int early_sweeps = 30;
// How often springs are looked at that had no impulse.
constexpr int sweeps_between_looks = 2;
// Where no more than this part of the springs is beyond the limits, a sweep ends with some over these and what is so
// many springs around them alone.
constexpr double few = 0.01;
constexpr int rings = 3, most_passes = 8;
// A spring that turns in one step by more than 25°, by the cosine of this, is pulled along where it ends.
constexpr double least_cosine = 0.9;

}  // namespace

StrainFilter::StrainFilter(const StrainLimit& limits, const Cloth& cloth)
    : limits_(limits),
      weight_(cloth.masses.cwiseInverse()),
      change_(static_cast<Index>(cloth.vertex_count()), Eigen::Vector3d::Zero()),
      last_change_(change_),
      held_(Vertices::Zero(cloth.vertex_count(), 3)),
      is_moved_(change_.size(), 0),
      springs_at_(change_.size()) {
  for (const int pin : cloth.pins) weight_[pin] = 0;
  std::vector<Index> springs;
  for (Index k = 0; k < cloth.springs.size(); ++k) {
    const Spring& s = cloth.springs[k];
    if (weight_[s.i] + weight_[s.j] > 0 && s.rest_length > 0) springs.push_back(k);
  }
  for (const StringLink& link : lay_out_strings(cloth, springs)) {
    const double rest_length = cloth.springs[link.spring].rest_length;
    for (const int end : {link.from, link.to}) springs_at_[Index(end)].push_back(limited_.size());
    limited_.push_back({.i = link.from,
                        .j = link.to,
                        .weight = weight_[link.from] + weight_[link.to],
                        .longest = limits.max_stretch * rest_length,
                        .shortest = limits.min_stretch.value_or(0) * rest_length,
                        .joined = link.joined});
    const Limited& s = limited_.back();
    ranges_.push_back({.i = s.i, .j = s.j, .least = s.shortest * s.shortest, .most = s.longest * s.longest});
  }
  moved_.reserve(change_.size());
  for (auto* list : {&active_, &watched_, &merged_, &restless_}) list->reserve(limited_.size());
  string_.reserve(limited_.size());
}

void StrainFilter::apply(const Vertices& x, double /*time*/, double h, Vertices& v) {
  find_beyond(x, h, v);
  converged_ = active_.empty();
  pace_ = 1;
  last_value_ = std::numeric_limits<double>::infinity();
  double value = 0;
  int next_look = 0;
  for (int sweep = 0; sweep < limits_.iterations && !converged_; ++sweep) {
    look_at_stop();
    const bool early = sweep < early_sweeps;
    if (sweep > 0) go_on(value);
    relax_all(early);
    pull_strings();
    value = assess();
    if (!restless_.empty() && static_cast<double>(restless_.size()) <= few * static_cast<double>(active_.size())) {
      settle(early);
      value = assess();
    }
    if (!restless_.empty() && sweep < next_look) continue;
    converged_ = look_around(x, early) && restless_.empty();
    next_look = sweep + sweeps_between_looks;
  }
  for (const int i : moved_) {
    const Eigen::RowVector3d more = change_[Index(i)].transpose() / h;
    v.row(i) += more;
    held_.row(i) = -more / h;
  }
}

/// Finds the springs that would end beyond their limits.
void StrainFilter::find_beyond(const Vertices& x, double h, const Vertices& v) {
  for (const int i : moved_) {
    change_[Index(i)].setZero();
    last_change_[Index(i)].setZero();
    held_.row(i).setZero();
    is_moved_[Index(i)] = 0;
  }
  for (const auto* list : {&active_, &watched_}) {
    for (const Index k : *list) limited_[k].stage = Stage::still;
  }
  moved_.clear();
  active_.clear();
  watched_.clear();
  target_ = x + h * v;
  for (Index k = 0; k < ranges_.size(); ++k) {
    const Range& range = ranges_[k];
    const double squared = (target_.row(range.i) - target_.row(range.j)).squaredNorm();
    if (squared > range.most || squared < range.least) active_.push_back(k);
  }
  const Index found = active_.size();
  for (Index k = 0; k < found; ++k) activate(active_[k], x);
}

/// Has a spring take part in the sweeps, and those around it watched.
void StrainFilter::activate(Index k, const Vertices& x) {
  const auto from_j_to_i = [](const Vertices& at, const Limited& s) -> Eigen::Vector3d {
    return (at.row(s.i) - at.row(s.j)).transpose();
  };
  Limited& s = limited_[k];
  s.stage = Stage::active;
  s.straight = true;
  s.end = from_j_to_i(target_, s);
  s.direction = from_j_to_i(x, s).normalized();
  s.impulse.setZero();
  s.last.setZero();
  s.push = 0;
  for (const int end : {s.i, s.j}) {
    if (weight_[end] == 0 || is_moved_[Index(end)] != 0) continue;
    is_moved_[Index(end)] = 1;
    moved_.push_back(end);
    for (const Index other : springs_at_[Index(end)]) {
      Limited& neighbour = limited_[other];
      if (neighbour.stage != Stage::still) continue;
      neighbour.stage = Stage::watched;
      neighbour.end = from_j_to_i(target_, neighbour);
      watched_.push_back(other);
    }
  }
}

/// Activates what has been brought beyond its limits, and gives what is beyond the tolerance, too, what it needs, so
/// that what this in turn brings beyond them is found as well. Returns whether there was none.
bool StrainFilter::look_around(const Vertices& x, bool early) {
  bool all_hold = true;
  const Index before = active_.size();
  for (Index next = 0; next < watched_.size();) {  // which activate() makes longer
    const Index k = watched_[next++];
    Limited& s = limited_[k];
    if (s.stage == Stage::active) continue;
    const Eigen::Vector3d end = end_of(s);
    const double squared = end.squaredNorm();
    if (squared <= s.longest * s.longest && squared >= s.shortest * s.shortest) continue;
    active_.push_back(k);
    activate(k, x);
    if (holds(s, end)) continue;
    all_hold = false;
    relax(s, early);
  }
  if (active_.size() > before) {
    const auto added = active_.begin() + static_cast<std::ptrdiff_t>(before);
    std::sort(added, active_.end());
    merged_.resize(active_.size());
    std::merge(active_.begin(), added, added, active_.end(), merged_.begin());
    active_.swap(merged_);
  }
  return all_hold;
}

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
  s.straight = s.straight && early && along >= 0 && along * along >= least_cosine * least_cosine * squared;
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

/// Whether a spring with this end is within its limits, to the tolerance.
bool StrainFilter::holds(const Limited& s, const Eigen::Vector3d& end) const {
  const double longest = (1 + limits_.tolerance) * s.longest, shortest = (1 - limits_.tolerance) * s.shortest;
  const double squared = end.squaredNorm();
  return squared <= longest * longest && squared >= shortest * shortest;
}

/// Returns φ, and finds what is beyond the tolerance.
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
  if (value > last_value_ && pace_ > 1) return go_back();
  last_value_ = value;
  const double next = (1 + std::sqrt(1 + 4 * pace_ * pace_)) / 2, part = (pace_ - 1) / next;
  pace_ = next;
  const auto extrapolate = [part](Eigen::Vector3d& now, Eigen::Vector3d& last) {
    const Eigen::Vector3d further = now + part * (now - last);
    last = now;
    now = further;
  };
  for (const Index k : active_) extrapolate(limited_[k].impulse, limited_[k].last);
  for (const int i : moved_) extrapolate(change_[Index(i)], last_change_[Index(i)]);
}

void StrainFilter::go_back() {
  pace_ = 1;
  for (const Index k : active_) limited_[k].impulse = limited_[k].last;
  for (const int i : moved_) change_[Index(i)] = last_change_[Index(i)];
}

}  // namespace drape
