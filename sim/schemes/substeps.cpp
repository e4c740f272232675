#include "sim/schemes/substeps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/schemes/registry.hpp"
#include "sim/schemes/sdirk2.hpp"
#include "sim/stability.hpp"

namespace drape {
namespace {

constexpr int gap = 2, widest_gap = 3;    // halvings between the two motions
constexpr int halvings_to_look_with = 6;  // where a step takes about the same time whatever k, as implicit ones do
constexpr std::size_t most_kept = 4;      // attempts

constexpr double halfway = 0.5;            // to the motion of higher order
constexpr double ahead_of_substep = 0.25;  // of a substep: how much earlier semi-implicit Euler drifts
constexpr double apart_of_same_order = 9;  // times the error of the shorter substeps
constexpr double most_default_errors = 10;

/// What the solves may do wrong, of the accuracy.
double solve_share(int order) { return order == 1 ? 0.2 : 0.1; }
/// How much looser the longer substeps are solved.
double looser(int order) { return order == 1 ? 4 : 10; }

/// What the longer substeps are of: of second order whatever the scheme, and solved by the method that is fastest with
/// long steps. Where they end does not depend on it.
IntegratorSettings beside(IntegratorSettings integrator) {
  if (is_explicit(integrator.method)) {
    integrator.method = Method::verlet;
  } else {
    integrator.method = Method::quasi_newton;
    integrator.scheme = TimeScheme::sdirk2;
  }
  integrator.max_iterations.reset();
  return integrator;
}

/// With how many halvings the alternation of liu13 is fastest: its iterations of a step are so many more the stiffer
/// the springs are beside the inertia that shorter steps are the cheaper ones, until they are about as stiff.
int fastest_for_local_global(const System& system) {
  constexpr double as_stiff = 3;
  const double halvings = std::ceil(std::log2((condition_bound(system) - 1) / as_stiff) / 2);
  return static_cast<int>(std::clamp<double>(halvings, 0, SubstepScheme::most_halvings));
}

/// Infinite where a place is not finite.
double largest_distance(const Vertices& a, const Vertices& b) {
  const double distance = std::sqrt((a - b).rowwise().squaredNorm().maxCoeff());
  return std::isfinite(distance) && std::isfinite(norm(a)) ? distance : std::numeric_limits<double>::infinity();
}

}  // namespace

/// A scheme with steps of another length.
struct SubstepScheme::Motion {
  /// @param acceleration that a solve may leave out of a substep [m/s²] @param looseness how many times its tolerance
  /// is what would follow
  Motion(const SubstepScheme::MakeSystem& make_system, double step, IntegratorSettings integrator, const State& start,
         double acceleration, double looseness)
      : system(make_system(step)), forces(system, start), state(start) {
    if (!is_explicit(integrator.method)) {
      const bool staged = integrator.scheme == TimeScheme::sdirk2;
      const double solved = staged ? Sdirk2::gamma * step : step;
      const double usual = Accuracy(integrator, system, system.inertia(solved)).tolerance;
      integrator.stop = StoppingRule::error;
      integrator.tolerance = looseness * std::min(acceleration * solved * solved, most_default_errors * usual);
    }
    scheme = method_type(integrator.method).make(integrator, system);
  }
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;

  void begin(const State& start, int halvings) {
    state = start;
    state.step <<= halvings;
    known_ = false;
  }

  /// @param early, late what to expect, see Scheme::expect(); or both null
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
  /// Of the last substep, if there is one and it solves for where it ends [m/s²].
  [[nodiscard]] const Vertices* acceleration() const { return known_ ? &acceleration_ : nullptr; }

  System system;
  StepForces forces;
  std::unique_ptr<Scheme> scheme;
  State state;

 private:
  Vertices acceleration_, before_;
  bool known_ = false;
};

/// Two motions through a step, one in 2^k substeps and beside it one in a quarter or an eighth as many.
class SubstepScheme::Attempt {
 public:
  Attempt(const SubstepScheme& owner, const State& start, int k)
      : halvings(k),
        gap_(owner.gap_for(k)),
        shorter_(owner.make_system_, std::ldexp(owner.step_, -k), owner.integrator_, start, owner.acceleration_, 1),
        longer_(owner.make_system_, std::ldexp(owner.step_, gap_ - k), beside(owner.integrator_), start,
                owner.acceleration_, looser(owner.order_)),
        error_per_apart_(owner.order_ == 1 ? 1 : 1 / apart_of_same_order) {
    if (owner.order_ != 1 || !filters().empty()) return;
    if (is_explicit(owner.integrator_.method)) {
      ahead_.setConstant(start.x.rows(), ahead_of_substep * shorter_.system.step);
      for (const int pin : shorter_.system.cloth.pins) ahead_[pin] = 0;
    } else {
      taken_ = halfway;
      error_per_apart_ -= taken_;
    }
  }

  void begin(const State& start) {
    shorter_.begin(start, halvings);
    longer_.begin(start, halvings - gap_);
    if (ahead_.size() > 0) shorter_.state.x += ahead_.asDiagonal() * start.v;
    done_ = 0;
    apart_ = 0;
  }

  /// Goes on by one of the longer substeps.
  void advance(StepReport& report) {
    for (int i = 0; i < 1 << gap_; ++i) {
      add(shorter_.advance(shorter_.acceleration(), shorter_.acceleration()), report);
      if (i == 0 && shorter_.acceleration() != nullptr) early_ = *shorter_.acceleration();
    }
    add(longer_.advance(&early_, shorter_.acceleration()), report);
    ++done_;
    apart_ = largest_distance(place(), longer_.state.x);
  }

  [[nodiscard]] bool over() const { return done_ == std::int64_t{1} << (halvings - gap_); }
  /// The error, as far as the motions have come [m].
  [[nodiscard]] double estimate() const { return apart_ * error_per_apart_; }
  /// What it is at the end of the step if it grows in proportion to time.
  [[nodiscard]] double projected() const {
    return std::ldexp(estimate() / static_cast<double>(done_), halvings - gap_);
  }
  /// Where the step ends, see SubstepScheme: to the bit where the two motions are where they are the same.
  void end(State& state) {
    state.x = place();
    state.v = shorter_.state.v;
    state.restraint = shorter_.state.restraint;
    if (taken_ == 0) return;
    state.x += taken_ * (longer_.state.x - shorter_.state.x);
    state.v += taken_ * (longer_.state.v - shorter_.state.v);
  }
  [[nodiscard]] const std::vector<std::unique_ptr<MotionFilter>>& filters() const { return shorter_.system.filters; }
  [[nodiscard]] Scheme& scheme() const { return *shorter_.scheme; }

  const int halvings;

 private:
  static void add(const StepReport& substep, StepReport& report) {
    report.iterations += substep.iterations;
    report.rise = std::max(report.rise, substep.rise);
  }

  /// Where the shorter substeps have come to.
  const Vertices& place() {
    if (ahead_.size() == 0) return shorter_.state.x;
    place_ = shorter_.state.x - ahead_.asDiagonal() * shorter_.state.v;
    return place_;
  }

  int gap_;
  Motion shorter_, longer_;
  Eigen::VectorXd ahead_;  // by how much each vertex of the shorter substeps is; empty: by nothing [s]
  Vertices place_;         // scratch
  Vertices early_;         // acceleration of the first of the shorter substeps beside one of the longer ones [m/s²]
  double taken_ = 0;       // of the way from where the shorter substeps end to where the longer ones do
  double error_per_apart_;
  std::int64_t done_ = 0;  // of the longer substeps
  double apart_ = 0;       // [m]
};

SubstepScheme::SubstepScheme(const SimulationSettings& settings, int fewest_halvings, MakeSystem make_system)
    : step_(settings.step),
      accuracy_(*settings.accuracy),
      integrator_(settings.integrator),
      make_system_(std::move(make_system)),
      order_(order_of(settings.integrator.step_method())),
      acceleration_(solve_share(order_) * 2 * accuracy_ / (step_ * step_)),
      fewest_(std::max(fewest_halvings + gap,
                       integrator_.method == Method::liu13 ? fastest_for_local_global(make_system_(step_)) : 0)),
      most_(std::max(most_halvings, fewest_ + gap)),
      first_(is_explicit(integrator_.method) ? fewest_ : std::max(fewest_, halvings_to_look_with)) {
  attempt(first_, {.x = settings.cloth.positions, .v = settings.cloth.velocities, .step = 0});
}

SubstepScheme::~SubstepScheme() = default;

SubstepScheme::Attempt& SubstepScheme::attempt(int halvings, const State& start) {
  auto found = std::ranges::find(attempts_, halvings, [](const auto& kept) { return kept->halvings; });
  if (found == attempts_.end()) {
    if (attempts_.size() == most_kept) attempts_.pop_back();
    found = attempts_.insert(attempts_.end(), std::make_unique<Attempt>(*this, start, halvings));
  }
  std::rotate(attempts_.begin(), found, found + 1);
  return *attempts_.front();
}

int SubstepScheme::gap_for(int halvings) const {
  const bool cheap = order_ == 1 && is_explicit(integrator_.method);
  return cheap ? std::clamp(gap + halvings - fewest_, gap, widest_gap) : gap;
}

int SubstepScheme::halvings_for(double estimate, int halvings) const {
  if (!std::isfinite(estimate)) return std::min(halvings + 1, most_);
  const double missing = std::log2(std::max(estimate / accuracy_, std::numeric_limits<double>::min())) / order_;
  return static_cast<int>(std::clamp<double>(halvings + std::ceil(missing), fewest_, most_));
}

StepReport SubstepScheme::advance(State& state, StepForces& /*forces*/) {
  StepReport report;
  Attempt* now = &attempt(first_, state);
  now->begin(state);
  now->advance(report);
  for (int next = halvings_for(now->projected(), first_);;) {
    if (next != now->halvings) {
      now = &attempt(next, state);
      now->begin(state);
    }
    const auto holds = [&] { return now->estimate() <= accuracy_; };
    // No number of shorter substeps makes finite what is not.
    while (!now->over() && (holds() || (next == most_ && std::isfinite(now->estimate())))) now->advance(report);
    report.converged = holds();
    if (report.converged || next == most_) break;
    next = std::max(next + 1, halvings_for(now->projected(), next));
  }
  now->end(state);
  for (const auto& filter : now->filters()) report.converged = report.converged && filter->converged();
  report.substeps = std::int64_t{1} << now->halvings;
  report.estimate = now->estimate();
  return report;
}

double SubstepScheme::residual() { return attempts_.front()->scheme().residual(); }
double SubstepScheme::error() { return attempts_.front()->scheme().error(); }
double SubstepScheme::unbalanced() { return attempts_.front()->scheme().unbalanced(); }
std::optional<Accuracy> SubstepScheme::accuracy() const { return attempts_.front()->scheme().accuracy(); }

}  // namespace drape
