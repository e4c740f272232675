#include "sim/schemes/substeps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "sim/schemes/registry.hpp"
#include "sim/schemes/sdirk2.hpp"
#include "sim/stability.hpp"

namespace drape {
namespace {

constexpr std::int64_t fewest_solved = 4;         // substeps of an implicit scheme; the companion has two
constexpr std::int64_t solved_to_look_with = 64;  // below this number, a step takes about the same time
constexpr std::size_t most_kept = 4;              // number of attempts

// Ratios of the error of the shorter substeps to the difference of the motions, and the accepted fraction of the
// accuracy; measured in docs/notes/accuracy.md.
constexpr double error_of_verlet = 1.0 / 3, error_of_sdirk2 = 0.7, error_of_backward_euler = 1;
constexpr double accepted = 0.8;
constexpr double solve_share = 0.1;  // fraction of the accuracy for the solver errors of both motions
constexpr double most_default_errors = 10;

/// Returns settings of both motions: the requested method with a second-order scheme.
IntegratorSettings of_second_order(IntegratorSettings integrator) {
  if (is_explicit(integrator.method)) integrator.method = Method::verlet;
  integrator.scheme = TimeScheme::sdirk2;
  return integrator;
}

/// Returns settings of the longer substeps: the fastest method for long steps, as it does not affect the result.
IntegratorSettings beside(IntegratorSettings integrator) {
  if (!is_explicit(integrator.method)) integrator.method = Method::quasi_newton;
  integrator.max_iterations.reset();
  return integrator;
}

/// Returns the number of substeps that is fastest for liu13. Its iterations grow with the ratio of stiffness to
/// inertia, so shorter steps are cheaper until both are about equal.
std::int64_t fastest_for_local_global(const System& system) {
  constexpr double as_stiff = 3;
  const double count = std::sqrt(std::max(1.0, (condition_bound(system) - 1) / as_stiff));
  return static_cast<std::int64_t>(std::min<double>(count, SubstepScheme::most_substeps));
}

/// Returns the largest distance; infinite if a position is not finite.
double largest_distance(const Vertices& a, const Vertices& b) {
  const double distance = std::sqrt((a - b).rowwise().squaredNorm().maxCoeff());
  return std::isfinite(distance) && std::isfinite(norm(a)) ? distance : std::numeric_limits<double>::infinity();
}

}  // namespace

/// A motion with another step length.
struct SubstepScheme::Motion {
  /// @param count        number of substeps in a step
  /// @param acceleration residual acceleration allowed in a solve [m/s²]
  Motion(const SubstepScheme& owner, std::int64_t count, IntegratorSettings integrator, const State& start)
      : system(owner.make_system_(owner.step_ / static_cast<double>(count))), forces(system, start), state(start) {
    system.whole_step = owner.step_;
    system.substeps = count;
    if (!is_explicit(integrator.method)) {
      const double solved = Sdirk2::gamma * system.step;
      const double usual = Accuracy(integrator, system, system.inertia(solved)).tolerance;
      integrator.stop = StoppingRule::error;
      integrator.tolerance = std::min(owner.acceleration_ * solved * solved, most_default_errors * usual);
    }
    scheme = method_type(integrator.method).make(integrator, system);
  }
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;

  void begin(const State& start) {
    state = start;
    state.step *= system.substeps;
    known_ = false;
  }

  /// @param early, late expected accelerations, see Scheme::expect(); or both null
  StepReport advance(const Vertices* early, const Vertices* late) {
    system.stop.look();
    if (late != nullptr) scheme->expect(*early, *late);
    const bool solves = scheme->accuracy().has_value();
    if (solves) before_ = state.v;
    const StepReport report = scheme->advance(state, forces);
    ++state.step;
    if (!solves) return report;
    acceleration_ = (state.v - before_) / system.step;
    known_ = true;
    return report;
  }
  /// Returns the mean acceleration of the last substep, if it was implicit [m/s²]; otherwise null.
  [[nodiscard]] const Vertices* acceleration() const { return known_ ? &acceleration_ : nullptr; }

  System system;
  StepForces forces;
  std::unique_ptr<Scheme> scheme;
  State state;

 private:
  Vertices acceleration_, before_;
  bool known_ = false;
};

/// Two motions through a step, with an even number of substeps and with half as many.
class SubstepScheme::Attempt {
 public:
  Attempt(const SubstepScheme& owner, const State& start, std::int64_t count)
      : substeps(count),
        shorter_(owner, count, owner.integrator_, start),
        longer_(owner, count / 2, beside(owner.integrator_), start),
        error_per_apart_(is_explicit(owner.integrator_.method) ? error_of_verlet : error_of_sdirk2) {
    if (!shorter_.system.contacts.empty()) error_per_apart_ = error_of_backward_euler;
  }

  void begin(const State& start) {
    shorter_.begin(start);
    longer_.begin(start);
    done_ = 0;
    apart_ = 0;
  }

  /// Advances by one of the longer substeps.
  void advance(StepReport& report) {
    add(shorter_.advance(shorter_.acceleration(), shorter_.acceleration()), report);
    if (shorter_.acceleration() != nullptr) early_ = *shorter_.acceleration();
    add(shorter_.advance(shorter_.acceleration(), shorter_.acceleration()), report);
    add(longer_.advance(&early_, shorter_.acceleration()), report);
    ++done_;
    apart_ = largest_distance(shorter_.state.x, longer_.state.x);
  }

  [[nodiscard]] bool over() const { return 2 * done_ == substeps; }
  /// Returns the error estimate so far [m].
  [[nodiscard]] double estimate() const { return apart_ * error_per_apart_; }
  /// Returns the estimate extrapolated linearly to the end of the step [m].
  [[nodiscard]] double projected() const {
    return estimate() * static_cast<double>(substeps) / static_cast<double>(2 * done_);
  }
  void end(State& state) const {
    state.x = shorter_.state.x;
    state.v = shorter_.state.v;
    state.restraint = shorter_.state.restraint;
  }
  [[nodiscard]] const std::vector<std::unique_ptr<MotionFilter>>& filters() const { return shorter_.system.filters; }
  [[nodiscard]] Scheme& scheme() const { return *shorter_.scheme; }

  const std::int64_t substeps;

 private:
  static void add(const StepReport& substep, StepReport& report) {
    report.iterations += substep.iterations;
    report.rise = std::max(report.rise, substep.rise);
  }

  Motion shorter_, longer_;
  Vertices early_;  // acceleration of the first shorter substep within a longer one [m/s²]
  double error_per_apart_;
  std::int64_t done_ = 0;  // number of longer substeps done
  double apart_ = 0;       // [m]
};

SubstepScheme::SubstepScheme(const SimulationSettings& settings, std::int64_t fewest_stable, MakeSystem make_system)
    : step_(settings.step),
      accuracy_(*settings.accuracy),
      integrator_(of_second_order(settings.integrator)),
      make_system_(std::move(make_system)),
      acceleration_(solve_share * accuracy_ / (step_ * step_)),
      fewest_(2 * fewest_stable),
      first_(fewest_) {
  if (!is_explicit(integrator_.method)) {
    fewest_ = std::max(fewest_, fewest_solved);
    if (integrator_.method == Method::liu13) {
      fewest_ = std::max(fewest_, fastest_for_local_global(make_system_(step_)));
    }
    first_ = std::max(fewest_, solved_to_look_with);
  }
  most_ = worthwhile(std::max(most_substeps, fewest_));
  fewest_ = worthwhile(fewest_);
  first_ = worthwhile(first_);
  attempt(first_, {.x = settings.cloth.positions, .v = settings.cloth.velocities, .step = 0});
}

SubstepScheme::~SubstepScheme() = default;

SubstepScheme::Attempt& SubstepScheme::attempt(std::int64_t substeps, const State& start) {
  auto found = std::ranges::find(attempts_, substeps, [](const auto& kept) { return kept->substeps; });
  if (found == attempts_.end()) {
    if (attempts_.size() == most_kept) attempts_.pop_back();
    found = attempts_.insert(attempts_.end(), std::make_unique<Attempt>(*this, start, substeps));
  }
  std::rotate(attempts_.begin(), found, found + 1);
  return *attempts_.front();
}

std::int64_t SubstepScheme::worthwhile(std::int64_t substeps) const {
  if (is_explicit(integrator_.method)) return substeps + substeps % 2;
  const auto power = static_cast<std::int64_t>(std::bit_ceil(static_cast<std::uint64_t>(substeps)));
  return substeps <= power / 4 * 3 && power >= 8 ? power / 4 * 3 : power;
}

std::int64_t SubstepScheme::substeps_for(double estimate, std::int64_t substeps) const {
  if (!std::isfinite(estimate)) return std::min(2 * substeps, most_);
  const double more = std::sqrt(estimate / (accepted * accuracy_));
  const double wanted = std::ceil(static_cast<double>(substeps) * more);
  if (wanted >= static_cast<double>(most_)) return most_;
  return worthwhile(std::max(static_cast<std::int64_t>(wanted), fewest_));
}

StepReport SubstepScheme::advance(State& state, StepForces& /*forces*/) {
  StepReport report;
  Attempt* now = &attempt(first_, state);
  now->begin(state);
  now->advance(report);
  for (std::int64_t next = substeps_for(now->projected(), first_);;) {
    if (next != now->substeps) {
      now = &attempt(next, state);
      now->begin(state);
    }
    const auto holds = [&] { return now->estimate() <= accepted * accuracy_; };
    // More substeps would not make a non-finite estimate finite.
    while (!now->over() && (holds() || (next == most_ && std::isfinite(now->estimate())))) now->advance(report);
    report.converged = holds();
    if (report.converged || next == most_) break;
    const std::int64_t least = worthwhile(next + next / 3);
    next = std::min(most_, std::max(least, substeps_for(now->projected(), next)));
  }
  now->end(state);
  for (const auto& filter : now->filters()) report.converged = report.converged && filter->converged();
  report.substeps = now->substeps;
  report.estimate = now->estimate();
  return report;
}

double SubstepScheme::residual() { return attempts_.front()->scheme().residual(); }
double SubstepScheme::error() { return attempts_.front()->scheme().error(); }
double SubstepScheme::residual_force() { return attempts_.front()->scheme().residual_force(); }
std::optional<Accuracy> SubstepScheme::accuracy() const { return attempts_.front()->scheme().accuracy(); }

StepReport DividedStep::advance(State& state, StepForces& forces) {
  StepReport report;
  const std::int64_t step = state.step;
  for (std::int64_t k = 0; k < system_.substeps; ++k) {
    system_.stop.look();
    state.step = step * system_.substeps + k;
    if (const std::int64_t done = scheme_->advance_at_once(state, forces, system_.substeps - k); done > 0) {
      k += done - 1;
      continue;
    }
    const StepReport substep = scheme_->advance(state, forces);
    report.converged = report.converged && substep.converged;
    for (const auto& filter : system_.filters) report.converged = report.converged && filter->converged();
  }
  state.step = step;
  report.substeps = system_.substeps;
  return report;
}

}  // namespace drape
