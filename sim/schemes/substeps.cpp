#include "sim/schemes/substeps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "sim/schemes/implicit_schemes.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/stability.hpp"

namespace drape {
namespace {

// Least numbers of substeps: a change of the acceleration needs two, stiff springs need four of an implicit scheme.
constexpr std::int64_t fewest_explicit = 2, fewest_solved = 4;
constexpr std::size_t most_kept = 4;  // number of motions

// Errors per change of the acceleration and squared substep, see SubstepScheme; of a first-order substep per kick and
// substep. Measured in docs/notes/accuracy.md.
constexpr double error_of_verlet = 1.0 / 12, error_of_sdirk2 = 1.0 / 16, error_of_first_order = 0.5;
// Fractions of the accuracy: the largest accepted estimate, those for which the next step keeps the number of substeps,
// and the one for which another number is chosen.
constexpr double accepted = 0.6, kept_from = 0.15, kept_until = 0.45, aimed = 0.35;
constexpr double solve_share = 0.2;  // fraction of the accuracy for the solver errors

/// Returns settings with a second-order scheme and the default tolerance.
IntegratorSettings of_second_order(IntegratorSettings integrator) {
  if (is_explicit(integrator.method)) integrator.method = Method::verlet;
  integrator.scheme = TimeScheme::sdirk2;
  integrator.stop.reset();
  integrator.tolerance.reset();
  return integrator;
}

/// Returns the number of substeps that is fastest for liu13. Its iterations grow with the ratio of stiffness to
/// inertia, so shorter steps are cheaper until both are about equal.
std::int64_t fastest_for_local_global(const System& system) {
  constexpr double as_stiff = 3;
  const double count = std::sqrt(std::max(1.0, (condition_bound(system) - 1) / as_stiff));
  return static_cast<std::int64_t>(std::min<double>(count, SubstepScheme::most_substeps));
}

}  // namespace

/// A motion through a step in equal substeps, which estimates its error.
class SubstepScheme::Motion {
 public:
  /// @param count number of substeps in a step
  Motion(const SubstepScheme& owner, std::int64_t count, const State& start)
      : system(owner.make_system_(owner.step_ / static_cast<double>(count))),
        forces_(system, start),
        free_(Eigen::ArrayXd::Ones(start.x.rows())) {
    system.whole_step = owner.step_;
    system.substeps = count;
    for (const int pin : system.cloth.pins) free_[pin] = 0;
    system.solve_limit = owner.solve_limit_;
    if (!is_explicit(owner.integrator_.method)) error_of_change_ = error_of_sdirk2;
    scheme = method_type(owner.integrator_.method).make(owner.integrator_, system);
  }
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;

  void begin(const State& start) {
    state_ = start;
    state_.step *= system.substeps;
    before_ = start.v;
    changes_.setZero(start.v.rows());
    done_ = 0;
    solved_ = true;
  }

  /// Advances by a substep.
  void advance(StepReport& report) {
    system.stop.check();
    const bool solves = scheme->accuracy().has_value();
    if (solves && done_ > 0) {
      expected_ = kick_ / system.step;
      scheme->expect(expected_, expected_);
    }
    const StepReport substep = scheme->advance(state_, forces_);
    ++state_.step;
    report.iterations += substep.iterations;
    report.rise = std::max(report.rise, substep.rise);
    solved_ = solved_ && substep.converged;
    note_kick();
    ++done_;
  }

  [[nodiscard]] bool over() const { return done_ == system.substeps; }
  /// Returns true if all substeps have converged.
  [[nodiscard]] bool solved() const { return solved_; }
  [[nodiscard]] bool finite() const { return std::isfinite(norm(state_.x)); }
  /// Returns the error estimate of the substeps done [m]; infinite if a velocity is not finite.
  [[nodiscard]] double estimate() const { return over() ? projected() : estimate_so_far(); }
  /// Returns the estimate extrapolated linearly to the end of the step [m]. There is one change less than substeps.
  [[nodiscard]] double projected() const {
    return estimate_so_far() * static_cast<double>(system.substeps) /
           static_cast<double>(std::max<std::int64_t>(done_ - 1, 1));
  }
  void end(State& state) const {
    state.x = state_.x;
    state.v = state_.v;
    state.restraint = state_.restraint;
    state.contact_forces = state_.contact_forces;
  }

  System system;
  std::unique_ptr<Scheme> scheme;

 private:
  [[nodiscard]] double estimate_so_far() const {
    const double changes = (free_ * changes_).maxCoeff<Eigen::PropagateNaN>();
    return std::isfinite(changes) ? error_of_change_ * system.step * changes : std::numeric_limits<double>::infinity();
  }
  /// Adds what the last substep changes in the velocities, and in their changes.
  void note_kick() {
    const auto length = [](const auto& of_axis) {
      return (of_axis(0).square() + of_axis(1).square() + of_axis(2).square()).sqrt();
    };
    const auto kick = [&](int axis) { return (state_.v.col(axis) - before_.col(axis)).array(); };
    if (done_ > 0) changes_ += length([&](int axis) { return kick(axis) - kick_.col(axis).array(); });
    if (scheme->first_order()) changes_ += error_of_first_order / error_of_change_ * length(kick);
    kick_ = state_.v - before_;
    before_ = state_.v;
  }

  StepForces forces_;
  State state_;
  Eigen::ArrayXd free_;     // 0 for pins, 1 for other vertices
  Eigen::ArrayXd changes_;  // sum of the lengths of the changes of the kicks, per vertex [m/s]
  Vertices before_, kick_;  // velocities before the next substep, and the change in the last one [m/s]
  Vertices expected_;       // [m/s²]
  double error_of_change_ = error_of_verlet;
  std::int64_t done_ = 0;  // number of substeps
  bool solved_ = true;
};

SubstepScheme::SubstepScheme(const SimulationSettings& settings, std::int64_t fewest_stable, MakeSystem make_system)
    : step_(settings.step),
      accuracy_(*settings.accuracy),
      integrator_(of_second_order(settings.integrator)),
      make_system_(std::move(make_system)),
      solve_limit_(solve_share * accuracy_ / (step_ * step_)),
      fewest_(fewest_stable) {
  if (is_explicit(integrator_.method)) {
    fewest_ =
        std::max(fewest_explicit, static_cast<std::int64_t>(std::ceil(calm_ratio * static_cast<double>(fewest_))));
  } else {
    fewest_ = std::max(fewest_solved, fewest_);
  }
  if (integrator_.method == Method::liu13) {
    fewest_ = std::max(fewest_, fastest_for_local_global(make_system_(step_)));
  }
  most_ = worthwhile(std::max(most_substeps, fewest_));
  fewest_ = worthwhile(fewest_);
  motion(fewest_, {.x = settings.cloth.positions, .v = settings.cloth.velocities, .step = 0});
}

SubstepScheme::~SubstepScheme() = default;

SubstepScheme::Motion& SubstepScheme::motion(std::int64_t substeps, const State& start) {
  auto found = std::ranges::find(motions_, substeps, [](const auto& kept) { return kept->system.substeps; });
  if (found == motions_.end()) {
    if (motions_.size() == most_kept) motions_.pop_back();
    found = motions_.insert(motions_.end(), std::make_unique<Motion>(*this, substeps, start));
  }
  std::rotate(motions_.begin(), found, found + 1);
  return *motions_.front();
}

std::int64_t SubstepScheme::worthwhile(std::int64_t substeps) const {
  if (is_explicit(integrator_.method)) return substeps;
  const auto power = static_cast<std::int64_t>(std::bit_ceil(static_cast<std::uint64_t>(substeps)));
  return substeps <= power / 4 * 3 && power >= 8 ? power / 4 * 3 : power;
}

std::int64_t SubstepScheme::substeps_for(double estimate, std::int64_t substeps) const {
  if (!std::isfinite(estimate)) return std::min(2 * substeps, most_);
  const double wanted = std::ceil(static_cast<double>(substeps) * std::sqrt(estimate / (aimed * accuracy_)));
  if (wanted >= static_cast<double>(most_)) return most_;
  return worthwhile(std::max(static_cast<std::int64_t>(wanted), fewest_));
}

std::int64_t SubstepScheme::next_substeps(double estimate, std::int64_t substeps) const {
  const bool kept = estimate >= kept_from * accuracy_ && estimate <= kept_until * accuracy_;
  return kept ? substeps : std::max(substeps_for(estimate, substeps), worthwhile(substeps / 2));
}

StepReport SubstepScheme::advance(State& state, StepForces& /*forces*/) {
  StepReport report;
  for (std::int64_t count = std::clamp(state.substeps, fewest_, most_);;) {
    Motion& now = motion(count, state);
    now.begin(state);
    const auto holds = [&] { return now.estimate() <= accepted * accuracy_; };
    // More substeps would not make non-finite positions finite.
    while (!now.over() && (holds() || (count == most_ && now.finite()))) now.advance(report);
    if (holds() || count == most_) {
      report.converged = holds() && now.solved();
      report.substeps = count;
      report.estimate = now.estimate();
      now.end(state);
      state.substeps = next_substeps(*report.estimate, count);
      return report;
    }
    const std::int64_t least = worthwhile(count + count / 3);
    count = std::min(most_, std::max(least, substeps_for(now.projected(), count)));
  }
}

double SubstepScheme::residual() { return motions_.front()->scheme->residual(); }
double SubstepScheme::error() { return motions_.front()->scheme->error(); }
double SubstepScheme::residual_force() { return motions_.front()->scheme->residual_force(); }
std::optional<Accuracy> SubstepScheme::accuracy() const { return motions_.front()->scheme->accuracy(); }

StepReport DividedStep::advance(State& state, StepForces& forces) {
  StepReport report;
  const std::int64_t step = state.step;
  for (std::int64_t k = 0; k < system_.substeps; ++k) {
    system_.stop.check();
    state.step = step * system_.substeps + k;
    if (const std::int64_t done = scheme_->advance_at_once(state, forces, system_.substeps - k); done > 0) {
      k += done - 1;
      continue;
    }
    const StepReport substep = scheme_->advance(state, forces);
    report.converged = report.converged && substep.converged;
  }
  state.step = step;
  report.substeps = system_.substeps;
  return report;
}

}  // namespace drape
