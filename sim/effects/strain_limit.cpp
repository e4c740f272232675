#include "sim/effects/strain_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/keys.hpp"
#include "sim/settings.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

// How far a sweep goes beyond what each spring alone would need, which carries a load across the cloth in few sweeps.
constexpr double over_relaxation = 1.8;
constexpr int early_sweeps = 100;
// How often springs are looked at that had no impulse.
constexpr int sweeps_between_looks = 2;
// A spring that turns in one step by more than 25°, by the cosine of this, is pulled along where it ends.
constexpr double least_cosine = 0.9;

/// Changes the velocities by impulses along the springs until no spring ends the step outside its limits (Provot 1995,
/// "Deformation constraints in a mass-spring model", on velocities as in Bridson, Fedkiw and Anderson 2002, section
/// 4.2). What ends the step within all upper limits is a convex set, with a cloth that stays where it is in it, and
/// what is looked for is its nearest point, by mass: Dykstra's method (Boyle and Dykstra 1986), successive
/// over-relaxation on the springs' impulses, so that what its neighbours do can take an impulse back.
///
/// Impulses that point along the springs as they end the step, as the nearest point has them, change the angular
/// momentum Σ m x × v. So at first they are kept along the springs as they are when the step starts, which keeps both
/// momenta to rounding; a spring for which that does not do, since it turns by more than 25° in the step or the others
/// have not settled after the early sweeps, gives up this restriction, and nothing else, for the rest of the step.
///
/// Only springs that have had an impulse are swept over. Those that have an end in common with one of these are looked
/// at after every second sweep, and before the limits are said to hold; the ends of all others are not moved.
class StrainFilter final : public MotionFilter {
 public:
  StrainFilter(const StrainLimit& limits, const Cloth& cloth)
      : limits_(limits),
        weight_(cloth.masses.cwiseInverse()),
        change_(static_cast<Index>(cloth.vertex_count()), Eigen::Vector3d::Zero()),
        is_moved_(change_.size(), 0),
        springs_at_(change_.size()) {
    for (const int pin : cloth.pins) weight_[pin] = 0;
    for (const Spring& s : cloth.springs) {
      if (weight_[s.i] + weight_[s.j] == 0 || s.rest_length == 0) continue;
      for (const int end : {s.i, s.j}) springs_at_[Index(end)].push_back(limited_.size());
      limited_.push_back({.i = s.i,
                          .j = s.j,
                          .weight = weight_[s.i] + weight_[s.j],
                          .longest = limits.max_stretch * s.rest_length,
                          .shortest = limits.min_stretch.value_or(0) * s.rest_length});
    }
    moved_.reserve(change_.size());
    active_.reserve(limited_.size());
    watched_.reserve(limited_.size());
  }

  void apply(const Vertices& x, double, double h, Vertices& v) override {
    find_beyond(x, h, v);
    converged_ = active_.empty();
    int next_look = 0;
    for (int sweep = 0; sweep < limits_.iterations && !converged_; ++sweep) {
      look_at_stop();
      for (const Index k : active_) relax(limited_[k], sweep < early_sweeps);
      const bool hold = std::all_of(active_.begin(), active_.end(), [&](Index k) { return holds(limited_[k]); });
      if (!hold && sweep < next_look) continue;
      converged_ = look_around(x) && hold;
      next_look = sweep + sweeps_between_looks;
    }
    for (const int i : moved_) v.row(i) += change_[Index(i)].transpose() / h;
  }

  [[nodiscard]] bool converged() const override { return converged_; }

 private:
  using Index = std::size_t;
  enum class Stage : unsigned char { still, watched, active };
  struct Limited {
    int i, j;
    double weight;             // 1/m of both [1/kg]
    double longest, shortest;  // [m]
    Stage stage = Stage::still;
    bool straight = true;  // impulses are along its direction at the start
    // From j to i at the end of the step as it would be without any impulse [m], and, of length 1, at its start.
    Eigen::Vector3d end = Eigen::Vector3d::Zero(), direction = end;
    Eigen::Vector3d impulse = Eigen::Vector3d::Zero();  // on i so far, times h [kg·m]
  };

  /// Finds the springs that would end beyond their limits.
  void find_beyond(const Vertices& x, double h, const Vertices& v) {
    for (const int i : moved_) {
      change_[Index(i)].setZero();
      is_moved_[Index(i)] = 0;
    }
    for (const Index k : active_) limited_[k].stage = Stage::still;
    for (const Index k : watched_) limited_[k].stage = Stage::still;
    moved_.clear();
    active_.clear();
    watched_.clear();
    target_ = x + h * v;
    for (Index k = 0; k < limited_.size(); ++k) {
      const Limited& s = limited_[k];
      const double squared = from_j_to_i(target_, s).squaredNorm();
      if (squared > s.longest * s.longest || squared < s.shortest * s.shortest) active_.push_back(k);
    }
    const Index found = active_.size();
    for (Index k = 0; k < found; ++k) activate(active_[k], x);
  }

  static Eigen::Vector3d from_j_to_i(const Vertices& x, const Limited& s) {
    return {x(s.i, 0) - x(s.j, 0), x(s.i, 1) - x(s.j, 1), x(s.i, 2) - x(s.j, 2)};
  }

  [[nodiscard]] Eigen::Vector3d end_of(const Limited& s) const {
    return s.end + (change_[Index(s.i)] - change_[Index(s.j)]);
  }

  /// Has a spring take part in the sweeps, and those around it watched.
  void activate(Index k, const Vertices& x) {
    Limited& s = limited_[k];
    s.stage = Stage::active;
    s.straight = true;
    s.end = from_j_to_i(target_, s);
    s.direction = from_j_to_i(x, s).normalized();
    s.impulse.setZero();
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

  /// Activates what has been brought beyond its limits; whether none of it is beyond the tolerance, too.
  bool look_around(const Vertices& x) {
    bool all_hold = true;
    const Index before = active_.size();
    const Index count = watched_.size();
    for (Index w = 0; w < count; ++w) {
      const Limited& s = limited_[watched_[w]];
      if (s.stage == Stage::active) continue;
      const double squared = end_of(s).squaredNorm();
      if (squared <= s.longest * s.longest && squared >= s.shortest * s.shortest) continue;
      all_hold = all_hold && holds(s);
      active_.push_back(watched_[w]);
      activate(watched_[w], x);
    }
    if (active_.size() > before) std::sort(active_.begin(), active_.end());
    return all_hold;
  }

  /// What an impulse of so much along a direction is after a sweep, which goes further than the others' so far ask for,
  /// but not to the other side.
  /// @param length along the direction without it
  /// @param across squared, the length across the direction
  static double relaxed(const Limited& s, double so_far, double length, double across) {
    const double most = std::sqrt(std::max(0.0, s.longest * s.longest - across));
    const double least = std::sqrt(std::max(0.0, s.shortest * s.shortest - across));
    const double wanted = (std::clamp(length, least, most) - length) / s.weight;
    const double relaxed = so_far + over_relaxation * (wanted - so_far);
    return relaxed * wanted > 0 ? relaxed : 0;
  }

  /// Gives a spring the impulse it needs now.
  void relax(Limited& s, bool early) {
    const Eigen::Vector3d d = end_of(s);
    const double squared = d.squaredNorm(), along = d.dot(s.direction);
    s.straight = s.straight && early && along >= 0 && along * along >= least_cosine * least_cosine * squared;
    Eigen::Vector3d impulse = s.impulse;
    if (s.straight) {
      const double so_far = impulse.dot(s.direction);
      const double across = std::max(0.0, squared - along * along);
      impulse = relaxed(s, so_far, along - s.weight * so_far, across) * s.direction;
    } else {
      const Eigen::Vector3d free = d - s.weight * impulse;
      const double length = free.norm();
      if (length == 0) return;
      const double so_far = std::copysign(impulse.norm(), impulse.dot(free));
      impulse = relaxed(s, so_far, length, 0) / length * free;
    }
    const Eigen::Vector3d more = impulse - s.impulse;
    s.impulse = impulse;
    change_[Index(s.i)] += weight_[s.i] * more;
    change_[Index(s.j)] -= weight_[s.j] * more;
  }

  /// Whether a spring is within its limits, to the tolerance.
  [[nodiscard]] bool holds(const Limited& s) const {
    const double longest = (1 + limits_.tolerance) * s.longest, shortest = (1 - limits_.tolerance) * s.shortest;
    const double squared = end_of(s).squaredNorm();
    return squared <= longest * longest && squared >= shortest * shortest;
  }

  StrainLimit limits_;
  Eigen::VectorXd weight_;  // 1/m, 0 for a pin [1/kg]
  std::vector<Limited> limited_;
  Vertices target_;                      // where the step would end without any impulse [m]
  std::vector<Eigen::Vector3d> change_;  // by how much the impulses change that [m]
  std::vector<int> moved_;               // the vertices for which they do
  std::vector<char> is_moved_;
  std::vector<Index> active_, watched_;
  std::vector<std::vector<Index>> springs_at_;  // of each vertex
  bool converged_ = true;
};

/// That an edge starts beyond a limit.
std::string beyond(const char* side, double limit, const Spring& s, double stretch) {
  return fmt::format(
      "the cloth starts beyond the limit, and one step would throw it back: the edge between the vertices {} "
      "and {} is {:.4g} times as long as at rest, {} {:g}",
      s.i, s.j, stretch, side, limit);
}

}  // namespace

void StrainLimit::describe(Keys& keys) {
  keys.add("max_stretch", &max_stretch, "", "Largest length of an edge, in multiples of its rest length.").at_least(1);
  keys.add("min_stretch", &min_stretch, "", "Smallest length of an edge, likewise. Default: no limit.")
      .at_least(0)
      .at_most(1);
  keys.add("iterations", &iterations, "",
           "Largest number of sweeps over the edges in a step. A step that needs more counts as not converged.")
      .at_least(1);
  keys.add("tolerance", &tolerance, "", "Fraction by which a limit may be exceeded.").above(0);
}

void StrainLimit::check(const SimulationSettings& settings, const ProblemSink& problem) const {
  const Cloth& cloth = settings.cloth;
  std::vector<bool> pinned(static_cast<std::size_t>(cloth.vertex_count()), false);
  for (const int pin : cloth.pins) pinned[static_cast<std::size_t>(pin)] = true;
  for (const Spring& s : cloth.springs) {
    if (pinned[static_cast<std::size_t>(s.i)] && pinned[static_cast<std::size_t>(s.j)]) continue;
    const double stretch = (cloth.positions.row(s.i) - cloth.positions.row(s.j)).norm() / s.rest_length;
    const double slack = tolerance;
    if (stretch > max_stretch * (1 + slack)) {
      return problem("max_stretch", beyond("above", max_stretch, s, stretch));
    }
    if (stretch < min_stretch.value_or(0) * (1 - slack)) {
      return problem("min_stretch", beyond("below", *min_stretch, s, stretch));
    }
  }
}

void StrainLimit::install(System& system) const {
  system.filters.push_back(std::make_unique<StrainFilter>(*this, system.cloth));
}

}  // namespace drape
