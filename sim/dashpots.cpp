#include "sim/dashpots.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <utility>

#include "drape/core/error.hpp"
#include "sim/bending/bending_energy.hpp"
#include "sim/parallel/vectors.hpp"
#include "sim/stability.hpp"

namespace drape {
namespace {

constexpr double rest_length_of_dashpots = 1e200;  // [m]

std::vector<Spring> dashpots_along(std::span<const Spring> springs, double time) {
  std::vector<Spring> result(springs.begin(), springs.end());
  for (Spring& s : result) {
    s.stiffness *= time;
    s.rest_length = rest_length_of_dashpots;
  }
  return result;
}

}  // namespace

SpringDashpots::SpringDashpots(std::span<const Spring> springs, double time, int vertex_count, const Threads& threads)
    : network_(dashpots_along(springs, time), vertex_count, threads) {
  network_.compute_blocks(Vertices::Zero(vertex_count, 3), 0, blocks_);
  directions_at_ = Vertices::Zero(vertex_count, 3);
}

void SpringDashpots::set_directions(const Vertices& x) {
  directions_at_ = x;
  network_.compute_blocks(x, 0, blocks_);
}

void SpringDashpots::add_product(const Vertices& v, Vertices& product) const {
  network_.add_product(blocks_, v, product);
}

void SpringDashpots::add_blocks(double factor, HessianBlocks& blocks) const {
  for (const Spring& s : network_.springs()) {
    const Eigen::RowVector3d d = directions_at_.row(s.i) - directions_at_.row(s.j);
    const double square = d.squaredNorm();
    const double scale = square > 0 ? factor * s.stiffness / square : 0;
    blocks.pairs.emplace_back(scale * d.transpose() * d);
  }
}

void SpringDashpots::add_bound(double factor, StiffnessBound& bound) const {
  for (const Spring& s : network_.springs()) {
    bound.pairs.push_back({.i = s.i, .j = s.j, .rest_length = 0, .stiffness = factor * s.stiffness});
  }
}

BendingDashpots::BendingDashpots(std::span<const CurvatureElement> elements, double time)
    : time_(time), pairs_(curvature_pairs(elements)) {
  for (const CurvatureElement& e : elements) {
    for (Eigen::Index row = 0; row < e.weights.rows(); ++row) {
      const std::size_t first = terms_.size();
      for (std::size_t c = 0; c < e.vertices.size(); ++c) {
        const double weight = e.weights(row, static_cast<Eigen::Index>(c));
        if (weight != 0) terms_.push_back({e.vertices[c], weight});
      }
      if (terms_.size() > first) components_.push_back({.first = first, .last = terms_.size()});
    }
  }
}

Eigen::RowVector3d BendingDashpots::rate(const Component& component, const Vertices& v) const {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  const Eigen::RowVector3d origin = v.row(terms_[component.first].vertex);
  for (const auto& [vertex, weight] : terms(component)) sum += weight * (v.row(vertex) - origin);
  return sum;
}

void BendingDashpots::set_directions(const Vertices& x) {
  constexpr double flat = 1e-10;  // relative to the terms of q, whose rounding has no direction
  for (Component& component : components_) {
    const Eigen::RowVector3d q = rate(component, x);
    double size = 0;
    for (const auto& [vertex, weight] : terms(component)) {
      size += std::abs(weight) * (x.row(vertex) - x.row(terms_[component.first].vertex)).norm();
    }
    const double length = q.norm();
    component.direction.setZero();
    if (length > flat * size) component.direction = q / length;
  }
}

void BendingDashpots::add_product(const Vertices& v, Vertices& product) const {
  for (const Component& component : components_) {
    Eigen::RowVector3d force = rate(component, v);
    const Eigen::RowVector3d& n = component.direction;
    if (!n.isZero(0)) force = n.dot(force) * n;
    force *= time_;
    for (const auto& [vertex, weight] : terms(component)) product.row(vertex) += weight * force;
  }
}

void BendingDashpots::add_blocks(double factor, HessianBlocks& blocks) const {
  const std::size_t begin = blocks.pairs.size();
  blocks.pairs.resize(begin + pairs_.size(), Eigen::Matrix3d::Zero());
  const auto block_of = [&](const Term& a, const Term& b) -> Eigen::Matrix3d& {
    const auto pair = std::minmax({a.vertex, b.vertex});
    const auto place = std::lower_bound(pairs_.begin(), pairs_.end(), pair,
                                        [](const Spring& s, const auto& p) { return std::pair(s.i, s.j) < p; });
    return blocks.pairs[begin + static_cast<std::size_t>(place - pairs_.begin())];
  };
  for (const Component& component : components_) {
    const Eigen::RowVector3d& n = component.direction;
    Eigen::Matrix3d along = Eigen::Matrix3d::Identity();
    if (!n.isZero(0)) along = n.transpose() * n;
    const auto all = terms(component);
    for (auto a = all.begin(); a != all.end(); ++a) {
      for (auto b = a + 1; b != all.end(); ++b) block_of(*a, *b) -= factor * time_ * a->weight * b->weight * along;
    }
  }
}

void BendingDashpots::add_bound(double factor, StiffnessBound& bound) const {
  for (Spring pair : pairs_) {
    pair.stiffness *= factor * time_;
    bound.pairs.push_back(pair);
  }
}

/// Hessian C/τ of the current step.
class StepDissipation::Hessian final : public EnergyHessian {
 public:
  explicit Hessian(const StepDissipation& of) : of_(of) {}
  void linearise(const Vertices& /*x*/, double /*time*/, double /*concavity*/) override {}
  void add_product(const Vertices& vector, Vertices& product) const override {
    scale(of_.threads_, 1 / of_.duration_, vector, of_.way_);
    of_.dashpots_->add_product(of_.way_, product);
  }
  void add_blocks(HessianBlocks& blocks) const override { of_.dashpots_->add_blocks(1 / of_.duration_, blocks); }

 private:
  const StepDissipation& of_;
};

StepDissipation::StepDissipation(std::shared_ptr<Dashpots> dashpots, double shortest, const Vertices& start,
                                 const Threads& threads)
    : dashpots_(std::move(dashpots)),
      threads_(threads),
      shortest_(shortest),
      duration_(shortest),
      start_(start),
      way_(start),
      product_(start) {
  dashpots_->set_directions(start);
}

void StepDissipation::begin(const Vertices& directions_at, const Vertices& start, double duration) {
  duration_ = duration;
  copy(threads_, start, start_);
  dashpots_->set_directions(directions_at);
}

double StepDissipation::evaluate(const Vertices& x) const {
  divided_difference(threads_, x, start_, duration_, way_);
  set_zero(threads_, product_);
  dashpots_->add_product(way_, product_);
  return duration_ / 2 * dot(threads_, way_, product_);
}

double StepDissipation::value(const Vertices& x) const { return evaluate(x); }

double StepDissipation::add_gradient(const Vertices& x, double /*time*/, Vertices& gradient) const {
  const double potential = evaluate(x);
  add_multiple(threads_, 1, product_, gradient);
  return potential;
}

std::unique_ptr<EnergyHessian> StepDissipation::make_hessian() const { return std::make_unique<Hessian>(*this); }

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
