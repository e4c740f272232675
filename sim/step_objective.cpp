#include "sim/step_objective.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/parallel/vectors.hpp"

namespace drape {
namespace {

constexpr double unit = std::numeric_limits<double>::epsilon();
constexpr double units = 4;  // number of roundings in a term of the energy or in a force

}  // namespace

StepObjective::StepObjective(const System& system, double duration)
    : system_(system),
      duration_(duration),
      springs_(system.network()),
      inertia_(system.inertia(duration)),
      free_inertia_(inertia_),
      push_(inertia_.cwiseInverse()),
      free_(Eigen::ArrayXd::Ones(system.cloth.vertex_count())),
      y_(system.cloth.vertex_count(), 3) {
  for (const int pin : system.cloth.pins) free_inertia_[pin] = push_[pin] = free_[pin] = 0;
  for (const Spring& s : system.springs) {
    stiffness_ += s.stiffness;
    elastic_scale_ += s.stiffness * s.rest_length * s.rest_length;
  }
  const StiffnessBound bound = system.stiffness_bound();
  for (const Spring& s : bound.pairs) {
    const auto d = system.cloth.positions.row(s.i) - system.cloth.positions.row(s.j);
    elastic_scale_ += std::abs(s.stiffness) * d.squaredNorm();
    cancelling_ += std::abs(s.stiffness) * d.squaredNorm() / 2;
  }
  Eigen::VectorXd stiffness = inertia_ + bound.vertices;
  bound.for_each_pair([&](const Spring& pair) { add_row_sums(pair, stiffness); });
  stiffness_ratio_ = stiffness.cwiseProduct(push_).maxCoeff();
}

void StepObjective::begin(const Vertices& x, const Vertices& v, const Vertices& force, double end) {
  const Kernels& k = kernels();
  time_ = end;
  start_x_ = &x;
  start_v_ = &v;
  sum(threads(), x, duration_, v, y_);
  for_ranges(threads(), x.rows(), [&](Eigen::Index first, Eigen::Index count) {
    for (int axis = 0; axis < 3; ++axis) {
      k.add_scaled(static_cast<std::size_t>(count), push_.data() + first, force.col(axis).data() + first,
                   y_.col(axis).data() + first);
    }
  });
  system_.place_pins(end, y_);
  scale_ = elastic_scale_ + sum_of(threads(), y_.rows(), [&](Eigen::Index first, Eigen::Index count) {
             return inertia_.segment(first, count).dot(y_.middleRows(first, count).rowwise().squaredNorm());
           });
}

StepObjective::Displacement StepObjective::largest_displacement(const Vertices& x) const {
  const Displacement squares = reduce(
      threads(), x.rows(),
      [&](Eigen::Index first, Eigen::Index count) {
        const auto whole = [&](int axis) {
          return x.col(axis).segment(first, count).array() - start_x_->col(axis).segment(first, count).array();
        };
        const auto forced = [&](int axis) {
          return whole(axis) - duration_ * start_v_->col(axis).segment(first, count).array();
        };
        const auto longest = [&](const auto& way) {
          return (free_.segment(first, count) * (way(0).square() + way(1).square() + way(2).square())).maxCoeff();
        };
        return Displacement{.total = longest(whole), .by_forces = longest(forced)};
      },
      [](const Displacement& most, const Displacement& next) {
        return Displacement{.total = std::max(most.total, next.total),
                            .by_forces = std::max(most.by_forces, next.by_forces)};
      });
  return {.total = std::sqrt(squares.total), .by_forces = std::sqrt(squares.by_forces)};
}

void StepObjective::predict_with_start_forces(Vertices& x, Vertices& gradient) const {
  copy(threads(), *start_x_, x);
  for (const int pin : system_.cloth.pins) x.row(pin) = y_.row(pin);
  evaluate(x, gradient);
  // ∇g(x₀) = M/τ² (x₀ − y) + ∇E(x₀), so the result is x₀ − τ² M⁻¹ ∇g(x₀).
  for (int axis = 0; axis < 3; ++axis) x.col(axis).array() -= push_.array() * gradient.col(axis).array();
}

double StepObjective::evaluate(const Vertices& x, Vertices& gradient) const {
  double value = springs_.evaluate(inertia_, y_, x, gradient);
  for (const auto& energy : system_.energies) value += energy->add_gradient(x, time_, gradient);
  for (const int pin : system_.cloth.pins) gradient.row(pin).setZero();
  return value;
}

double StepObjective::inertial_value(const Vertices& x) const {
  return sum_of(threads(), x.rows(),
                [&](Eigen::Index first, Eigen::Index count) {
                  double twice = 0;
                  for (int axis = 0; axis < 3; ++axis) {
                    const auto way = x.col(axis).segment(first, count) - y_.col(axis).segment(first, count);
                    twice += (free_inertia_.segment(first, count).array() * way.array().square()).sum();
                  }
                  return twice;
                }) /
         2;
}

double StepObjective::rounding(double value) const {
  const double size = std::abs(value);  // rounding makes the bending energy of flat cloth slightly negative
  return units * unit * (size + std::sqrt(2 * size * scale_)) + unit * cancelling_;
}

double StepObjective::least_elastic(double energy, double distance) const {
  const double root = std::max(0.0, std::sqrt(energy) - 2 * distance * std::sqrt(stiffness_ / 2));
  return root * root;
}

double StepObjective::error_bound(const Vertices& gradient) const {
  const double square = reduce(
      threads(), gradient.rows(),
      [&](Eigen::Index first, Eigen::Index count) {
        const auto squares = [&](int axis) { return gradient.col(axis).segment(first, count).array().square(); };
        const auto length = squares(0) + squares(1) + squares(2);
        return (push_.segment(first, count).array().square() * length).maxCoeff();
      },
      [](double most, double next) { return std::max(most, next); });
  return std::sqrt(square);
}

double StepObjective::error_rounding() const {
  constexpr double several = 64;  // measured: Newton's method ends at 0.1 to 2 times one unit, L-BFGS at up to 160
  return several * unit * stiffness_ratio_ * y_.cwiseAbs().maxCoeff();
}

StepForces::StepForces(const System& system, const State& start)
    : system_(system), constant_(Vertices::Zero(start.x.rows(), 3)), push_(&constant_) {
  for (const auto& force : system.forces) {
    if (force->constant()) force->add(start, 0, constant_);
  }
  force_ = constant_;
}

template <class Wanted>
const Vertices& StepForces::sum(const State& state, double time, const Wanted& wanted) {
  push_ = &constant_;
  for (const auto& force : system_.forces) {
    if (force->constant() || !wanted(*force)) continue;
    if (push_ == &constant_) force_ = constant_;
    push_ = &force_;
    force->add(state, time, force_);
  }
  return *push_;
}

const Vertices& StepForces::all(const State& state, double time) {
  return sum(state, time, [](const Force&) { return true; });
}

const Vertices& StepForces::sum_position_forces(const State& state, double time) {
  return sum(state, time, [](const Force& force) { return !force.depends_on_velocity(); });
}

bool StepForces::any_depends_on_velocity() const {
  return std::any_of(system_.forces.begin(), system_.forces.end(),
                     [](const auto& f) { return f->depends_on_velocity(); });
}

void StepForces::sum_velocity_forces(const State& state, double time, Vertices& force) const {
  force.setZero(state.x.rows(), 3);
  for (const auto& f : system_.forces) {
    if (f->depends_on_velocity()) f->add(state, time, force);
  }
}

void StepForces::record_velocity_force(const Vertices& mean) {
  force_ = *push_ + mean;
  push_ = &force_;
}

}  // namespace drape
