#include "sim/schemes/damping_kick.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <utility>

#include "drape/core/error.hpp"
#include "sim/parallel/vectors.hpp"
#include "sim/stability.hpp"

namespace drape {
namespace {

constexpr double epsilon = 2.0 / 13;  // keeps the polynomial below 1 inside the interval
constexpr int fewest_stages = 2, most_stages = 1000;
constexpr std::int64_t most_substeps_of_a_kick = 24;

/// Coefficients of the method with s stages.
struct Chebyshev {
  double w0, w1, b, a;
  double range;  ///< largest z

  explicit Chebyshev(int stages) {
    w0 = 1 + epsilon / (static_cast<double>(stages) * stages);
    double before = 1, now = w0, slope_before = 0, slope = 1, bend_before = 0, bend = 0;
    for (int j = 2; j <= stages; ++j) {
      const double next = 2 * w0 * now - before;
      const double next_slope = 2 * now + 2 * w0 * slope - slope_before;
      const double next_bend = 4 * slope + 2 * w0 * bend - bend_before;
      before = std::exchange(now, next);
      slope_before = std::exchange(slope, next_slope);
      bend_before = std::exchange(bend, next_bend);
    }
    w1 = slope / bend;
    b = bend / (slope * slope);
    a = 1 - b * now;
    range = (w0 + 1) / w1;
  }
};

}  // namespace

int DampingKick::stages_for(double z) {
  int stages = fewest_stages;
  while (stages <= most_stages && Chebyshev(stages).range < z) ++stages;
  return stages;
}

DampingKick::DampingKick(const System& system, double duration)
    : system_(system), rate_(system.cloth.masses.cwiseInverse()) {
  const double frequency = highest_frequency(system);
  stages_ = stages_for(duration * system.damping_time * frequency * frequency);
  if (stages_ > most_stages) {
    throw UsageError(fmt::format(
        "an explicit step of {:g} s with internal damping of {:g} s needs more than {} evaluations of the dashpots: "
        "use a shorter step or relaxation_time, or method = \"liu13\", \"implicit\" or \"quasi-newton\"",
        duration, system.damping_time, most_stages));
  }
  const Chebyshev coefficients(stages_);
  w0_ = coefficients.w0;
  a_ = coefficients.a;
  b_ = coefficients.b;
  rate_ *= coefficients.w1 * duration;
  for (const int pin : system.cloth.pins) rate_[pin] = 0;
}

std::int64_t DampingKick::kicks_in(std::int64_t substeps) {
  const std::int64_t kicks = (substeps + most_substeps_of_a_kick - 1) / most_substeps_of_a_kick;
  // An odd number has one in the middle of the step, so that the number of substeps must be odd, too.
  return substeps % 2 == 0 && kicks % 2 == 1 ? kicks + 1 : kicks;
}

bool DampingKick::acts_in(std::int64_t step, std::int64_t substeps) {
  const std::int64_t substep = step % substeps, nearest = std::min(substep, substeps - 1 - substep);
  const std::int64_t kicks = kicks_in(substeps), kick = nearest * kicks / substeps;
  return (2 * kick + 1) * substeps / (2 * kicks) == nearest;
}

void DampingKick::set_directions(const Vertices& x) {
  for (const auto& dashpots : system_.dashpots) dashpots->set_directions(x);
}

void DampingKick::advance(double factor, const Vertices& from, Vertices& to) {
  product_.resize(from.rows(), 3);
  set_zero(system_.threads, product_);
  for (const auto& dashpots : system_.dashpots) dashpots->add_product(from, product_);
  for_ranges(system_.threads, from.rows(), [&](Eigen::Index first, Eigen::Index count) {
    const auto rate = rate_.segment(first, count).array();
    for (int axis = 0; axis < 3; ++axis) {
      const auto part = [&](auto& v) { return v.col(axis).segment(first, count).array(); };
      part(to) = factor * (w0_ * part(from) - rate * part(product_)) - part(to);
    }
  });
}

void DampingKick::apply(Vertices& v) {
  before_ = v;
  last_.setZero(v.rows(), 3);
  advance(1, before_, last_);
  for (int j = 2; j <= stages_; ++j) {
    advance(2, last_, before_);
    std::swap(before_, last_);
  }
  scale(system_.threads, a_, v, v);
  add_multiple(system_.threads, b_, last_, v);
}

void DampingKick::apply_within(const Vertices& before, Vertices& v) {
  half_kick_.resize(v.rows(), 3);
  divided_difference(system_.threads, v, before, 2, half_kick_);
  sum(system_.threads, before, 1, half_kick_, v);
  apply(v);
  add_multiple(system_.threads, 1, half_kick_, v);
}

}  // namespace drape
