#include "sim/solvers/quasi_newton.hpp"

#include <algorithm>

#include "sim/parallel/vectors.hpp"

namespace drape {
namespace {

constexpr int quasi_newton_iterations = 500;

// Iterations on the whole cloth between patch iterations. A patch iteration is repeated while the patches are so small
// that it is cheaper.
constexpr int between_patches = 5;
constexpr int most_rounds = 4;
constexpr double next_share = 0.03;
// A Newton step on the whole cloth costs as much as about thirty other iterations, or fewer for small cloth. The first
// is taken once the minimum may be near, further ones at growing intervals.
constexpr int before_look = 6, before_look_at_large = 12, between_looks = 6, most_between_looks = 96;

}  // namespace

QuasiNewton::QuasiNewton(const System& system, const StepObjective& objective, const IntegratorSettings& settings)
    : FactoredMinimiser(system, objective, settings, default_iterations(settings, quasi_newton_iterations)),
      history_(system.cloth.vertex_count(), system.threads),
      preconditioned_(Vertices::Zero(system.cloth.vertex_count(), 3)),
      direction_(preconditioned_) {
  const int count = FreeVertices(system.cloth).count();
  looks_ = count >= fine_cloth && accuracy().rule == StoppingRule::error;
  before_look_ = count < large_cloth ? before_look : before_look_at_large;
  if (looks_ && system.energies.empty()) {
    patches_.emplace(system, objective);
  }
}

void QuasiNewton::start() {
  history_.clear();
  wait_ = between_patches;
  round_ = 0;
  until_look_ = before_look_;
  gap_ = between_looks;
}

double QuasiNewton::settle_patches(Iterate& point) {
  if (!patches_ || wait_-- > 0) return 0;
  const double change =
      patches_->minimise_patches(point, round_ == 0 ? PatchNewton::usual_share : next_share, tolerance());
  if (change > 0) history_.clear();
  const bool again = change > 0 && ++round_ < most_rounds;
  wait_ = again ? 0 : between_patches;
  if (!again) round_ = 0;
  return change;
}

double QuasiNewton::take_newton_step(Iterate& point) {
  if (!looks_ || until_look_-- > 0) return 0;
  until_look_ = gap_;
  gap_ = std::min(2 * gap_, most_between_looks);
  find_newton_step(point, direction_);
  const double length = descend(point, direction_, dot(objective().threads(), point.gradient, direction_));
  if (length == 0) return 0;
  note_newton_step(direction_);
  history_.clear();
  return length * norm(objective().threads(), direction_);
}

double QuasiNewton::iterate(Iterate& point) {
  if (const double change = settle_patches(point); change > 0) return change;
  if (const double change = take_newton_step(point); change > 0) return change;
  const Threads& threads = objective().threads();
  factor().solve(point.gradient, preconditioned_);
  history_.observe(point.gradient, preconditioned_);
  history_.find_direction(preconditioned_, direction_);
  double slope = dot(threads, point.gradient, direction_);
  if (!(slope > 0)) {
    // Rounding has spoilt the pairs; A⁻¹∇g always descends.
    history_.clear();
    history_.observe(point.gradient, preconditioned_);
    direction_ = preconditioned_;
    slope = dot(threads, point.gradient, direction_);
  }
  const double length = descend(point, direction_, slope);
  history_.moved(direction_, length, slope);
  return length * norm(threads, direction_);
}

}  // namespace drape
