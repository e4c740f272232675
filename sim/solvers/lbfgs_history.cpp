#include "sim/solvers/lbfgs_history.hpp"

#include <algorithm>
#include <numeric>

#include "sim/parallel/vectors.hpp"

namespace drape {
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
