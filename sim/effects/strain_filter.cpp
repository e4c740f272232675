#include "sim/effects/strain_filter.hpp"

#include <algorithm>
#include <limits>

namespace drape {
namespace {

constexpr int early_sweeps = 30;
constexpr int sweeps_in_turn = 60;  // when alternating with contact, as both constraints together may have no solution
// Number of sweeps between checks of springs without an impulse.
constexpr int sweeps_between_looks = 2;
// Largest fraction of unconverged springs for which a sweep ends with passes over these and their neighbours.
constexpr double few = 0.01;

}  // namespace

StrainFilter::StrainFilter(const StrainLimit& limits, const Cloth& cloth)
    : limits_(limits),
      free_(cloth.pins.empty()),
      weight_(cloth.masses.cwiseInverse()),
      change_(static_cast<Index>(cloth.vertex_count()), Eigen::Vector3d::Zero()),
      last_change_(change_),
      restraint_{.acceleration = Vertices::Zero(cloth.vertex_count(), 3),
                 .tensions = Eigen::VectorXd::Zero(std::ssize(cloth.springs))},
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
    spring_.push_back(static_cast<Eigen::Index>(link.spring));
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
  expected_.reserve(limited_.size());
  string_.reserve(limited_.size());
}

void StrainFilter::begin(const State& state, double /*time*/) {
  expected_.clear();
  const Eigen::VectorXd& tensions = state.restraint.tensions;
  if (tensions.size() != restraint_.tensions.size()) return;
  for (Index k = 0; k < spring_.size(); ++k) {
    if (const double tension = tensions[spring_[k]]; tension != 0) expected_.push_back({k, tension});
  }
}

void StrainFilter::apply(const Vertices& x, double /*time*/, double h, Vertices& v) {
  relax_from(x, h, v, limits_.iterations);
}

/// Solves for the impulses from the unconstrained velocities, starting with the expected impulses.
void StrainFilter::relax_from(const Vertices& x, double h, Vertices& v, int most_sweeps) {
  forget();
  find_beyond(x, h, v);
  for (const Pull& pull : expected_) give(limited_[pull.limited], -h * h * pull.tension);
  converged_ = active_.empty();
  pace_ = 1;
  ahead_ = 0;
  last_value_ = std::numeric_limits<double>::infinity();
  double value = 0;
  int next_look = 0;
  for (int sweep = 0; sweep < most_sweeps && !converged_; ++sweep) {
    check_stop();
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
    restraint_.acceleration.row(i) = -more / h;
  }
  for (const Index k : active_) restraint_.tensions[spring_[k]] = -limited_[k].push / (h * h);
}

bool StrainFilter::adjust(const Vertices& x, double, double h, Vertices& v) {
  const double most = (1 + limits_.tolerance) * (1 + limits_.tolerance);
  const double least = (1 - limits_.tolerance) * (1 - limits_.tolerance);
  target_ = x + h * v;
  const bool hold = std::ranges::all_of(ranges_, [&](const Range& range) {
    const double squared = (target_.row(range.i) - target_.row(range.j)).squaredNorm();
    return squared <= most * range.most && squared >= least * range.least;
  });
  if (hold) return false;
  // The filter's own impulses are the initial guess, so the velocities are taken without them.
  for (const int i : moved_) v.row(i) -= change_[Index(i)].transpose() / h;
  expected_.clear();
  for (const Index k : active_) {
    if (limited_[k].push != 0) expected_.push_back({k, -limited_[k].push / (h * h)});
  }
  relax_from(x, h, v, std::min(limits_.iterations, sweeps_in_turn));
  return true;
}

/// Resets the data of the last step.
void StrainFilter::forget() {
  for (const int i : moved_) {
    change_[Index(i)].setZero();
    last_change_[Index(i)].setZero();
    restraint_.acceleration.row(i).setZero();
    is_moved_[Index(i)] = 0;
  }
  for (const Index k : active_) restraint_.tensions[spring_[k]] = 0;
  for (const auto* list : {&active_, &watched_}) {
    for (const Index k : *list) limited_[k].stage = Stage::still;
  }
  moved_.clear();
  active_.clear();
  watched_.clear();
}

/// Finds the springs that would end beyond their limits, and those with an initial impulse.
void StrainFilter::find_beyond(const Vertices& x, double h, const Vertices& v) {
  target_ = x + h * v;
  auto expected = expected_.begin();
  for (Index k = 0; k < ranges_.size(); ++k) {
    const Range& range = ranges_[k];
    const double squared = (target_.row(range.i) - target_.row(range.j)).squaredNorm();
    const bool pulls = expected != expected_.end() && expected->limited == k;
    if (pulls) ++expected;
    if (pulls || squared > range.most || squared < range.least) active_.push_back(k);
  }
  const Index found = active_.size();
  for (Index k = 0; k < found; ++k) activate(active_[k], x);
}

/// Adds a spring to the sweeps and its neighbours to the watched springs.
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

/// Activates watched springs beyond their limits. Those beyond the tolerance are updated at once, so that the same
/// check finds the springs which that affects. Returns true if there were none.
bool StrainFilter::look_around(const Vertices& x, bool early) {
  bool all_hold = true;
  const Index before = active_.size();
  for (Index next = 0; next < watched_.size();) {  // activate() appends to this list
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

}  // namespace drape
