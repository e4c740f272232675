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
class StrainFilter final : public MotionFilter {
 public:
  StrainFilter(const StrainLimit& limits, const Cloth& cloth) : limits_(limits), weight_(cloth.masses.cwiseInverse()) {
    for (const int pin : cloth.pins) weight_[pin] = 0;
    for (const Spring& s : cloth.springs) {
      if (weight_[s.i] + weight_[s.j] == 0 || s.rest_length == 0) continue;
      limited_.push_back({.i = s.i,
                          .j = s.j,
                          .weight = weight_[s.i] + weight_[s.j],
                          .longest = limits.max_stretch * s.rest_length,
                          .shortest = limits.min_stretch.value_or(0) * s.rest_length});
    }
    target_.resize(cloth.vertex_count(), 3);
  }

  void apply(const Vertices& x, double, double h, Vertices& v) override {
    target_ = x + h * v;
    for (Limited& spring : limited_) spring.begin();
    converged_ = false;
    for (int sweep = 0; sweep < limits_.iterations && !converged_; ++sweep) {
      look_at_stop();
      bool any = false;
      for (Limited& spring : limited_) any |= relax(spring, sweep < early_sweeps, x, h, v);
      converged_ = !any || holds();
    }
  }

  [[nodiscard]] bool converged() const override { return converged_; }

 private:
  struct Limited {
    int i, j;
    double weight;                                              // 1/m of both [1/kg]
    double longest, shortest;                                   // [m]
    bool active = false;                                        // has had an impulse in this step
    bool straight = true;                                       // these are along its direction at the start
    Eigen::RowVector3d direction = Eigen::RowVector3d::Zero();  // from j to i at the start, once it is active
    Eigen::RowVector3d impulse = Eigen::RowVector3d::Zero();    // on i so far, times h [kg·m]

    void begin() {
      active = false;
      straight = true;
      impulse.setZero();
    }

    /// The impulse after a sweep that goes further than the others' impulses so far ask for, but not to the other side;
    /// d from j to i as they would end.
    [[nodiscard]] Eigen::RowVector3d next(const Eigen::RowVector3d& d) const {
      const Eigen::RowVector3d free = d - weight * impulse;
      Eigen::RowVector3d along = direction;
      double across = 0;  // [m²]
      if (straight) {
        across = std::max(0.0, free.squaredNorm() - std::pow(free.dot(direction), 2));
      } else {
        const double length = free.norm();
        if (length == 0) return impulse;
        along = free / length;
      }
      const double length = free.dot(along);
      const double most = std::sqrt(std::max(0.0, longest * longest - across));
      const double least = std::sqrt(std::max(0.0, shortest * shortest - across));
      const double wanted = (std::clamp(length, least, most) - length) / weight;
      const double so_far = std::copysign(impulse.norm(), impulse.dot(along));
      const double relaxed = so_far + over_relaxation * (wanted - so_far);
      return (relaxed * wanted > 0 ? relaxed : 0) * along;
    }
  };

  /// Gives a spring the impulse it needs now; false if it needs none.
  bool relax(Limited& s, bool early, const Vertices& x, double h, Vertices& v) {
    const Eigen::RowVector3d d = target_.row(s.i) - target_.row(s.j);
    const double squared = d.squaredNorm();
    const bool within = squared <= s.longest * s.longest && squared >= s.shortest * s.shortest;
    if (!s.active) {
      if (within) return false;
      s.active = true;
      s.direction = (x.row(s.i) - x.row(s.j)).normalized();
    }
    s.straight = s.straight && early && d.dot(s.direction) >= least_cosine * std::sqrt(squared);
    const Eigen::RowVector3d impulse = s.next(d);
    const Eigen::RowVector3d change = impulse - s.impulse;
    s.impulse = impulse;
    target_.row(s.i) += weight_[s.i] * change;
    target_.row(s.j) -= weight_[s.j] * change;
    v.row(s.i) += weight_[s.i] / h * change;
    v.row(s.j) -= weight_[s.j] / h * change;
    return true;
  }

  /// Whether every spring is within its limits, to the tolerance.
  [[nodiscard]] bool holds() const {
    const double above = 1 + limits_.tolerance, below = 1 - limits_.tolerance;
    return std::all_of(limited_.begin(), limited_.end(), [&](const Limited& s) {
      const double length = (target_.row(s.i) - target_.row(s.j)).norm();
      return length <= above * s.longest && length >= below * s.shortest;
    });
  }

  StrainLimit limits_;
  Eigen::VectorXd weight_;  // 1/m, 0 for a pin [1/kg]
  std::vector<Limited> limited_;
  Vertices target_;  // where the step would end
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
