#include "sim/solvers/quasi_newton.hpp"

#include <algorithm>
#include <numeric>

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

namespace {

std::size_t index(int k) { return static_cast<std::size_t>(k); }

}  // namespace

LbfgsHistory::LbfgsHistory(int vertex_count, const Threads& threads)
    : threads_(threads), last_preconditioned_(vertex_count, 3) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  for (Pair& pair : pairs_) {
    pair.step.resize(vertex_count, 3);
    pair.preconditioned.resize(vertex_count, 3);
  }
}

void LbfgsHistory::clear() {
  count_ = 0;
  pending_ = false;
}

void LbfgsHistory::moved(const Vertices& direction, double length, double slope) {
  pending_ = length > 0;
  if (!pending_) return;
  if (count_ == capacity) {
    std::rotate(order_.begin(), order_.begin() + 1, order_.end());  // drops the oldest pair
  } else {
    ++count_;
  }
  scale(threads_, -length, direction, newest().step);
  newest().step_gradient = -length * slope;
}

void LbfgsHistory::observe(const Vertices& gradient, const Vertices& preconditioned) {
  const double before = gradient_norm_;
  gradient_norm_ = dot(threads_, gradient, preconditioned);
  if (pending_) {
    Pair& pair = newest();
    subtract(threads_, preconditioned, last_preconditioned_, pair.preconditioned);
    // Product with the gradient before the move: A⁻¹q·∇g = ∇g_new·A⁻¹∇g_old − ∇g_old·A⁻¹∇g_old.
    pair.preconditioned_gradient = dot(threads_, gradient, last_preconditioned_) - before;
  }
  measure(gradient);
  // Drop pairs without positive curvature. They carry no information about a nearby minimum.
  if (pending_ && !(newest().step_change[slot(count_ - 1)] > 0)) --count_;
  pending_ = false;
  copy(threads_, preconditioned, last_preconditioned_);
}

void LbfgsHistory::measure(const Vertices& gradient) {
  std::array<const double*, 2 * std::size_t{capacity}> vectors{};
  std::array<double, 2 * std::size_t{capacity}> products{};
  for (int k = 0; k < count_; ++k) {
    vectors[2 * index(k)] = pair(k).step.data();
    vectors[2 * index(k) + 1] = pair(k).preconditioned.data();
  }
  dots(threads_, std::span(vectors).first(index(2 * count_)), gradient, products.data());
  for (int k = 0; k < count_; ++k) {
    const double step_gradient = products[2 * index(k)], preconditioned_gradient = products[2 * index(k) + 1];
    if (pending_) {
      // The newest q is the change of the gradient.
      const std::size_t last = slot(count_ - 1);
      pair(k).step_change[last] = step_gradient - pair(k).step_gradient;
      pair(k).preconditioned_change[last] = preconditioned_gradient - pair(k).preconditioned_gradient;
      newest().preconditioned_change[slot(k)] = pair(k).preconditioned_change[last];
    }
    pair(k).step_gradient = step_gradient;
    pair(k).preconditioned_gradient = preconditioned_gradient;
  }
}

void LbfgsHistory::find_direction(const Vertices& preconditioned, Vertices& direction) const {
  if (count_ == 0) {
    copy(threads_, preconditioned, direction);
    return;
  }
  std::array<double, capacity> alpha{}, beta{};
  for (int k = count_ - 1; k >= 0; --k) {
    double projection = pair(k).step_gradient;
    for (int j = k + 1; j < count_; ++j) projection -= alpha[index(j)] * pair(k).step_change[slot(j)];
    alpha[index(k)] = projection / pair(k).step_change[slot(k)];
  }
  const int last = count_ - 1;
  const double scale = pair(last).step_change[slot(last)] / pair(last).preconditioned_change[slot(last)];
  for (int k = 0; k < count_; ++k) {
    double projection = pair(k).preconditioned_gradient;
    for (int j = 0; j < count_; ++j) projection -= alpha[index(j)] * pair(k).preconditioned_change[slot(j)];
    projection *= scale;
    for (int j = 0; j < k; ++j) projection += (alpha[index(j)] - beta[index(j)]) * pair(j).step_change[slot(k)];
    beta[index(k)] = projection / pair(k).step_change[slot(k)];
  }

  // H⁻¹∇g = γ(A⁻¹∇g − Σ α A⁻¹q) + Σ (α − β) s
  std::array<const double*, 2 * std::size_t{capacity}> vectors{};
  std::array<double, 2 * std::size_t{capacity}> factors{};
  for (int k = 0; k < count_; ++k) {
    vectors[2 * index(k)] = pair(k).step.data();
    factors[2 * index(k)] = (alpha[index(k)] - beta[index(k)]) / scale;
    vectors[2 * index(k) + 1] = pair(k).preconditioned.data();
    factors[2 * index(k) + 1] = -alpha[index(k)];
  }
  combine(threads_, scale, preconditioned, std::span(vectors).first(index(2 * count_)), factors.data(), direction);
}

}  // namespace drape
