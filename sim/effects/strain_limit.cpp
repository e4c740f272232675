#include "sim/effects/strain_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

namespace drape {
namespace {

struct Limits {
  double max_stretch = 1.1;
  std::optional<double> min_stretch;
  int iterations = 1000;
  double tolerance = 1e-3;
};

// How far a sweep goes beyond what each spring alone would need: far at first, which carries a load across the cloth in
// few sweeps, and later less, as springs that turn meanwhile would never come to rest.
constexpr double over_relaxation = 1.8, late_over_relaxation = 1.0;
constexpr int early_sweeps = 200;
// A spring that turns in one step by more than 25°, by the cosine of this, is pulled along its new direction.
constexpr double least_cosine = 0.9;

/// Changes the velocities by impulses along the springs until no spring ends the step outside its limits (Provot 1995,
/// "Deformation constraints in a mass-spring model", on velocities as in Bridson, Fedkiw and Anderson 2002, section
/// 4.2): successive over-relaxation on the impulses, which are kept from changing sign, so that a spring is only ever
/// pulled to its upper limit or pushed to its lower one and what its neighbours do can take an impulse back.
///
/// The impulses of a spring are opposite, and point along it as it is when the step starts: Σ m x × v with that x is
/// both angular momenta, before and after, so both momenta are kept to rounding. Only a spring that turns by more than
/// 25° in the step is pulled along its new direction.
class StrainLimit final : public MotionFilter {
 public:
  StrainLimit(const Limits& limits, const Cloth& cloth) : limits_(limits), weight_(cloth.masses.cwiseInverse()) {
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
    for (Limited& spring : limited_) spring.impulse = 0;
    converged_ = false;
    for (int sweep = 0; sweep < limits_.iterations && !converged_; ++sweep) {
      const double relaxation = sweep < early_sweeps ? over_relaxation : late_over_relaxation;
      bool any = false;
      for (Limited& spring : limited_) any |= relax(spring, relaxation, x, h, v);
      converged_ = !any || holds();
    }
  }

  [[nodiscard]] bool converged() const override { return converged_; }

 private:
  struct Limited {
    int i, j;
    double weight;                                              // 1/m of both [1/kg]
    double longest, shortest;                                   // [m]
    double impulse = 0;                                         // so far, times h; positive pushes apart [kg·m]
    Eigen::RowVector3d direction = Eigen::RowVector3d::Zero();  // from j to i, set by the first impulse
  };

  /// Gives a spring the impulse it needs now; false if it needs none.
  bool relax(Limited& s, double relaxation, const Vertices& x, double h, Vertices& v) {
    const Eigen::RowVector3d d = target_.row(s.i) - target_.row(s.j);
    const double squared = d.squaredNorm();
    const bool within = squared <= s.longest * s.longest && squared >= s.shortest * s.shortest;
    if (within && s.impulse == 0) return false;
    if (s.impulse == 0) s.direction = (x.row(s.i) - x.row(s.j)).normalized();
    double along = d.dot(s.direction);
    if (along < least_cosine * std::sqrt(squared)) {
      if (within) return false;
      s.impulse = 0;  // what it was so far stays, but can no longer be taken back
      s.direction = d.normalized();
      along = d.dot(s.direction);
    }
    // Of the length along the direction, what would be without the impulse so far, and what the limits leave.
    const double across = squared - along * along;
    const double free = along - s.weight * s.impulse;
    const double most = std::sqrt(std::max(0.0, s.longest * s.longest - across));
    const double least = std::sqrt(std::max(0.0, s.shortest * s.shortest - across));
    const double wanted = (std::clamp(free, least, most) - free) / s.weight;
    double impulse = s.impulse + relaxation * (wanted - s.impulse);
    if (wanted <= 0) impulse = std::min(impulse, 0.0);
    if (wanted >= 0) impulse = std::max(impulse, 0.0);
    const Eigen::RowVector3d change = (impulse - s.impulse) * s.direction;
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

  Limits limits_;
  Eigen::VectorXd weight_;  // 1/m, 0 for a pin [1/kg]
  std::vector<Limited> limited_;
  Vertices target_;  // where the step would end
  bool converged_ = true;
};

class StrainLimitEffect final : public Effect {
 public:
  void describe(Keys& keys) override {
    keys.add("max_stretch", &limits_.max_stretch, "",
             "Longest that an edge may become, in multiples of its rest length.")
        .at_least(1);
    keys.add("min_stretch", &limits_.min_stretch, "",
             "Shortest that it may become, likewise. Without it there is no such limit.")
        .at_least(0)
        .at_most(1);
    keys.add("iterations", &limits_.iterations, "",
             "Sweeps over the edges in a step, at most; a step that needs more counts as not converged.")
        .at_least(1);
    keys.add("tolerance", &limits_.tolerance, "", "By which fraction a limit may be exceeded.").above(0);
  }

  void check(const SimulationSettings& settings, const ProblemSink& problem) const override {
    const Cloth& cloth = settings.cloth;
    std::vector<bool> pinned(static_cast<std::size_t>(cloth.vertex_count()), false);
    for (const int pin : cloth.pins) pinned[static_cast<std::size_t>(pin)] = true;
    for (const Spring& s : cloth.springs) {
      if (pinned[static_cast<std::size_t>(s.i)] && pinned[static_cast<std::size_t>(s.j)]) continue;
      const double stretch = (cloth.positions.row(s.i) - cloth.positions.row(s.j)).norm() / s.rest_length;
      const double slack = limits_.tolerance;
      if (stretch > limits_.max_stretch * (1 + slack)) {
        return problem("max_stretch", message("above", limits_.max_stretch, s, stretch));
      }
      if (stretch < limits_.min_stretch.value_or(0) * (1 - slack)) {
        return problem("min_stretch", message("below", *limits_.min_stretch, s, stretch));
      }
    }
  }

  void install(System& system) const override {
    system.filters.push_back(std::make_unique<StrainLimit>(limits_, system.cloth));
  }

 private:
  static std::string message(const char* side, double limit, const Spring& s, double stretch) {
    return fmt::format(
        "the cloth starts beyond the limit, from where one step would throw it back: the edge between the vertices {} "
        "and {} is {:.4g} times as long as at rest, {} {:g}",
        s.i, s.j, stretch, side, limit);
  }

  Limits limits_;
};

}  // namespace

std::unique_ptr<Effect> make_strain_limit() { return std::make_unique<StrainLimitEffect>(); }

}  // namespace drape
