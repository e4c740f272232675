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

constexpr int gap = 2;  // halvings between the two motions
constexpr int shorter_in_longer = 1 << gap;
constexpr int halvings_to_look_with = 6;  // where a step takes about the same time whatever k, as implicit ones do
constexpr std::size_t most_kept = 4;      // attempts

constexpr double solve_share = 0.3;  // of the accuracy
constexpr double most_default_errors = 10;

/// How many times the error of the shorter substeps the two motions are apart, see SubstepScheme.
double apart_per_error(int order) { return order == 1 ? 2 : 9; }
/// How much looser the longer substeps are solved.
double looser(int order) { return order == 1 ? 3 : 6; }

/// The same with the method that is fastest with long steps. Where they end does not depend on it.
IntegratorSettings solved_fast(IntegratorSettings integrator) {
  if (!is_explicit(integrator.method)) integrator.method = Method::quasi_newton;
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
  }

  StepReport advance() {
    system.stop.look();
    StepReport report = scheme->advance(state, forces);
    ++state.step;
    return report;
  }

  System system;
  StepForces forces;
  std::unique_ptr<Scheme> scheme;
  State state;
};

/// Two motions through a step, one in 2^k substeps and beside it one in a quarter as many.
class SubstepScheme::Attempt {
 public:
  Attempt(const SubstepScheme& owner, const State& start, int k)
      : halvings(k),
        apart_per_error_(apart_per_error(owner.order_)),
        shorter_(owner.make_system_, std::ldexp(owner.step_, -k), owner.integrator_, start, owner.acceleration_, 1),
        longer_(owner.make_system_, std::ldexp(owner.step_, gap - k), solved_fast(owner.integrator_), start,
                owner.acceleration_, looser(owner.order_)) {}

  void begin(const State& start) {
    shorter_.begin(start, halvings);
    longer_.begin(start, halvings - gap);
    done_ = 0;
    parted_ = 0;
  }

  /// Goes on by one of the longer substeps.
  void advance(StepReport& report) {
    for (int i = 0; i < shorter_in_longer; ++i) add(shorter_.advance(), report);
    add(longer_.advance(), report);
    ++done_;
    parted_ = largest_distance(shorter_.state.x, longer_.state.x);
  }

  [[nodiscard]] bool over() const { return done_ == std::int64_t{1} << (halvings - gap); }
  /// The error of the shorter substeps, as far as they have come [m].
  [[nodiscard]] double estimate() const { return parted_ / apart_per_error_; }
  /// What it is at the end of the step if it grows in proportion to time.
  [[nodiscard]] double projected() const { return std::ldexp(estimate() / static_cast<double>(done_), halvings - gap); }
  [[nodiscard]] const Motion& result() const { return shorter_; }
  [[nodiscard]] Scheme& scheme() const { return *shorter_.scheme; }

  const int halvings;

 private:
  static void add(const StepReport& substep, StepReport& report) {
    report.iterations += substep.iterations;
    report.rise = std::max(report.rise, substep.rise);
  }

  double apart_per_error_;
  Motion shorter_, longer_;
  std::int64_t done_ = 0;  // of the longer substeps
  double parted_ = 0;      // [m]
};

SubstepScheme::SubstepScheme(const SimulationSettings& settings, int fewest_halvings, MakeSystem make_system)
    : step_(settings.step),
      accuracy_(*settings.accuracy),
      integrator_(settings.integrator),
      make_system_(std::move(make_system)),
      order_(order_of(settings.integrator.step_method())),
      acceleration_(solve_share * 2 * accuracy_ / (step_ * step_)),
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
    while (!now->over() && (holds() || next == most_)) now->advance(report);
    report.converged = holds();
    if (report.converged || next == most_) break;
    next = std::max(next + 1, halvings_for(now->projected(), next));
  }
  state.x = now->result().state.x;
  state.v = now->result().state.v;
  for (const auto& filter : now->result().system.filters) report.converged = report.converged && filter->converged();
  report.substeps = std::int64_t{1} << now->halvings;
  report.estimate = now->estimate();
  return report;
}

double SubstepScheme::residual() { return attempts_.front()->scheme().residual(); }
double SubstepScheme::error() { return attempts_.front()->scheme().error(); }
double SubstepScheme::unbalanced() { return attempts_.front()->scheme().unbalanced(); }
std::optional<Accuracy> SubstepScheme::accuracy() const { return attempts_.front()->scheme().accuracy(); }

}  // namespace drape
