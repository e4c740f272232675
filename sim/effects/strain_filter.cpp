// Steps of a sweep of StrainFilter.

#include "sim/effects/strain_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace drape {
namespace {

using Index = std::size_t;
constexpr Index no_spring = std::numeric_limits<Index>::max();
constexpr double straightest_corner = -0.8;  // cosine of the largest corner between consecutive springs
constexpr int most_rounds = 4;               // maximum number of updates of a string's slack set
// Regularisation of each spring, as a fraction of its weight. A string between two pins that is too short for their
// distance would otherwise need an infinite tension.
constexpr double slackening = 1e-3;

/// Next spring in the string, for both ends of each spring.
class Continuations {
 public:
  Continuations(const Cloth& cloth, const std::vector<Index>& springs)
      : cloth_(cloth), next_(cloth.springs.size(), {no_spring, no_spring}) {
    std::vector<std::vector<Index>> at(static_cast<Index>(cloth.vertex_count()));
    for (const Index k : springs) {
      for (const int end : {cloth.springs[k].i, cloth.springs[k].j}) at[static_cast<Index>(end)].push_back(k);
    }
    for (const int pin : cloth.pins) at[static_cast<Index>(pin)].clear();
    for (int vertex = 0; vertex < cloth.vertex_count(); ++vertex) join(vertex, at[static_cast<Index>(vertex)]);
  }

  [[nodiscard]] Index& next(Index k, int at) { return next_[k][cloth_.springs[k].i == at ? 0 : 1]; }
  [[nodiscard]] int other_end(Index k, int end) const {
    return cloth_.springs[k].i == end ? cloth_.springs[k].j : cloth_.springs[k].i;
  }

 private:
  void join(int vertex, const std::vector<Index>& around) {
    std::vector<std::tuple<double, Index, Index>> pairs;
    for (auto a = around.begin(); a != around.end(); ++a) {
      for (auto b = a + 1; b != around.end(); ++b) {
        const double cosine = away(*a, vertex).dot(away(*b, vertex));
        if (cosine < straightest_corner) pairs.emplace_back(cosine, *a, *b);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [cosine, a, b] : pairs) {
      if (next(a, vertex) != no_spring || next(b, vertex) != no_spring) continue;
      next(a, vertex) = b;
      next(b, vertex) = a;
    }
  }

  [[nodiscard]] Eigen::RowVector3d away(Index k, int vertex) const {
    return (cloth_.rest.row(other_end(k, vertex)) - cloth_.rest.row(vertex)).normalized();
  }

  const Cloth& cloth_;
  std::vector<std::array<Index, 2>> next_;
};

/// Solves for the changes of all taut springs, given those of slack ones.
void eliminate(std::span<Tension> string) {
  double next = 0, more = 0;
  for (Index k = 0; k < string.size(); ++k) {
    Tension& t = string[k];
    const double pivot = (1 + slackening) * t.weight - t.coupling * next;
    t.more = t.slack ? -t.pull : (t.excess + t.coupling * more) / pivot;
    t.next = t.slack || k + 1 == string.size() ? 0 : string[k + 1].coupling / pivot;
    next = t.next;
    more = t.more;
  }
  for (Index k = string.size() - 1; k-- > 0;) string[k].more += string[k].next * string[k + 1].more;
}

/// Releases springs that would push and adds slack ones that became too long. Returns true if any changed.
bool exchange(std::span<Tension> string) {
  bool any = false;
  for (Index k = 0; k < string.size(); ++k) {
    Tension& t = string[k];
    if (t.pull <= 0) continue;
    double left = t.excess - t.weight * t.more;
    if (k > 0) left += t.coupling * string[k - 1].more;
    if (k + 1 < string.size()) left += string[k + 1].coupling * string[k + 1].more;
    const bool slack = t.slack ? left <= 0 : t.pull + t.more < 0;
    any = any || slack != t.slack;
    t.slack = slack;
  }
  return any;
}

}  // namespace

std::vector<StringLink> lay_out_strings(const Cloth& cloth, const std::vector<std::size_t>& springs) {
  Continuations continuations(cloth, springs);
  std::vector<char> laid(cloth.springs.size(), 0);
  std::vector<StringLink> links;
  links.reserve(springs.size());
  for (const Index seed : springs) {
    if (laid[seed] != 0) continue;
    // Go back to the start of the string, or once around a ring.
    Index first = seed;
    int from = cloth.springs[seed].i;
    for (Index before = continuations.next(first, from); before != no_spring && before != seed;) {
      first = before;
      from = continuations.other_end(first, from);
      before = continuations.next(first, from);
    }
    bool joined = false;
    for (Index k = first; k != no_spring && laid[k] == 0; joined = true) {
      const int to = continuations.other_end(k, from);
      links.push_back({.spring = k, .from = from, .to = to, .joined = joined});
      laid[k] = 1;
      k = continuations.next(k, to);
      from = to;
    }
  }
  return links;
}

void balance(std::span<Tension> string) {
  for (Tension& t : string) t.slack = t.pull <= 0;
  for (int round = 0; round < most_rounds; ++round) {
    eliminate(string);
    if (!exchange(string)) break;
  }
  for (Tension& t : string) t.more = std::max(t.more, -t.pull);
}

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
  const ClothPiece* const piece = find_piece(cloth, limits.cloth);
  for (Index k = 0; k < cloth.springs.size(); ++k) {
    const Spring& s = cloth.springs[k];
    if (piece != nullptr && !piece->has(s.i)) continue;
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
  for (auto* list : {&active_, &watched_, &merged_, &unconverged_}) list->reserve(limited_.size());
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
  for (const Pull& pull : expected_) set_impulse(limited_[pull.limited], -h * h * pull.tension);
  converged_ = active_.empty();
  pace_ = 1;
  ahead_ = 0;
  last_value_ = std::numeric_limits<double>::infinity();
  double value = 0;
  int next_look = 0;
  for (int sweep = 0; sweep < most_sweeps && !converged_; ++sweep) {
    check_stop();
    const bool early = sweep < early_sweeps;
    if (sweep > 0) extrapolate(value);
    relax_all(early);
    pull_strings();
    value = assess();
    if (!unconverged_.empty() &&
        static_cast<double>(unconverged_.size()) <= few * static_cast<double>(active_.size())) {
      settle(early);
      value = assess();
    }
    if (!unconverged_.empty() && sweep < next_look) continue;
    converged_ = look_around(x, early) && unconverged_.empty();
    next_look = sweep + sweeps_between_looks;
  }
  for (const int i : moved_) {
    const Eigen::RowVector3d more = change_[Index(i)].transpose() / h;
    v.row(i) += more;
    restraint_.acceleration.row(i) = -more / h;
  }
  for (const Index k : active_) restraint_.tensions[spring_[k]] = -limited_[k].push / (h * h);
}

double StrainFilter::tolerated_gain() const {
  double sum = 0;
  for (const Index k : active_) {
    const Limited& s = limited_[k];
    sum += std::abs(restraint_.tensions[spring_[k]]) * limits_.tolerance * (s.push > 0 ? s.shortest : s.longest);
  }
  return sum;
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
    set_impulse(s, (std::clamp(length, least, most) - length) / s.weight);
    return;
  }
  const Eigen::Vector3d free = end - s.weight * s.impulse;
  const double length = free.norm();
  if (length > 0) s.direction = free / length;
  set_impulse(s, (std::clamp(length, s.shortest, s.longest) - length) / s.weight);
}

/// Sweeps over the unconverged springs and their neighbours until they hold.
void StrainFilter::settle(bool early) {
  for (const Index k : unconverged_) limited_[k].stage = Stage::unconverged;
  for (Index ring = 0, inner = 0; ring < rings; ++ring) {
    for (const Index outer = unconverged_.size(); inner < outer; ++inner) {
      for (const int end : {limited_[unconverged_[inner]].i, limited_[unconverged_[inner]].j}) {
        for (const Index other : springs_at_[Index(end)]) {
          if (limited_[other].stage != Stage::active) continue;
          limited_[other].stage = Stage::unconverged;
          unconverged_.push_back(other);
        }
      }
    }
  }
  const auto hold = [this](Index k) { return holds(limited_[k], end_of(limited_[k])); };
  for (int pass = 0; pass < most_passes; ++pass) {
    for (const Index k : unconverged_) relax(limited_[k], early);
    if (std::ranges::all_of(unconverged_, hold)) break;
  }
  for (const Index k : unconverged_) limited_[k].stage = Stage::active;
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
    if (t.more != 0) set_impulse(limited_[active_[first + k]], -(t.pull + t.more));
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
  unconverged_.clear();
  for (const Index k : active_) {
    const Limited& s = limited_[k];
    const Eigen::Vector3d way = change_[Index(s.i)] - change_[Index(s.j)];
    if (!holds(s, s.end + way)) unconverged_.push_back(k);
    // ‖δ‖²_M is the work of the impulses along δ.
    value += s.impulse.dot(s.end + 0.5 * way) - s.push * (s.push > 0 ? s.shortest : s.longest);
  }
  return value;
}

/// Extrapolates the impulses of a sweep along their last change. If the last extrapolation raised φ to this value,
/// restores the impulses of the previous sweep instead.
void StrainFilter::extrapolate(double value) {
  if (value > last_value_ && ahead_ > 0) return undo_extrapolation();
  last_value_ = value;
  const double next = (1 + std::sqrt(1 + 4 * pace_ * pace_)) / 2;
  ahead_ = (pace_ - 1) / next;
  pace_ = next;
  const auto continue_change = [part = ahead_](Eigen::Vector3d& now, Eigen::Vector3d& last) {
    const Eigen::Vector3d further = now + part * (now - last);
    last = now;
    now = further;
  };
  for (const Index k : active_) continue_change(limited_[k].impulse, limited_[k].last);
  for (const int i : moved_) continue_change(change_[Index(i)], last_change_[Index(i)]);
}

void StrainFilter::undo_extrapolation() {
  pace_ = 1;
  ahead_ = 0;
  for (const Index k : active_) limited_[k].impulse = limited_[k].last;
  for (const int i : moved_) change_[Index(i)] = last_change_[Index(i)];
}

}  // namespace drape
