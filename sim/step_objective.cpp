#include "sim/step_objective.hpp"

#include <cmath>
#include <limits>

namespace drape {
namespace {

constexpr double unit = std::numeric_limits<double>::epsilon();
constexpr double units = 4;  // roundings on the way to a term of the energy, or to a force

}  // namespace

StepObjective::StepObjective(const System& system, double duration)
    : system_(system),
      duration_(duration),
      springs_(system.springs, system.cloth.vertex_count()),
      inertia_(system.inertia(duration)),
      free_inertia_(inertia_),
      push_(inertia_.cwiseInverse()),
      y_(system.cloth.vertex_count(), 3) {
  for (const int pin : system.cloth.pins) free_inertia_[pin] = push_[pin] = 0;
  for (const Spring& s : system.springs) elastic_scale_ += s.stiffness * s.rest_length * s.rest_length;
  const StiffnessBound bound = system.stiffness_bound();
  for (std::size_t p = system.springs.size(); p < bound.pairs.size(); ++p) {
    const Spring& s = bound.pairs[p];
    const auto d = system.cloth.positions.row(s.i) - system.cloth.positions.row(s.j);
    elastic_scale_ += std::abs(s.stiffness) * d.squaredNorm();
    cancelling_ += std::abs(s.stiffness) * d.squaredNorm() / 2;
  }
  Eigen::VectorXd stiffness = inertia_ + bound.vertices;
  for (const Spring& s : bound.pairs) {
    stiffness[s.i] += 2 * std::abs(s.stiffness);
    stiffness[s.j] += 2 * std::abs(s.stiffness);
  }
  stiffness_ratio_ = stiffness.cwiseProduct(push_).maxCoeff();
}

void StepObjective::begin(const Vertices& x, const Vertices& v, const Vertices& force, double end) {
  const Kernels& k = kernels();
  const auto count = static_cast<std::size_t>(x.rows());
  time_ = end;
  y_ = x;
  k.add_multiple(3 * count, duration_, v.data(), y_.data());
  for (int axis = 0; axis < 3; ++axis) {
    k.add_scaled(count, push_.data(), force.col(axis).data(), y_.col(axis).data());
  }
  system_.place_pins(end, y_);
  scale_ = elastic_scale_ + inertia_.dot(y_.rowwise().squaredNorm());
}

double StepObjective::evaluate(const Vertices& x, Vertices& gradient) const {
  double value = springs_.evaluate(inertia_, y_, x, gradient);
  for (const auto& energy : system_.energies) value += energy->add_gradient(x, time_, gradient);
  for (const int pin : system_.cloth.pins) gradient.row(pin).setZero();
  return value;
}

double StepObjective::inertial_value(const Vertices& x) const {
  double twice = 0;
  for (int axis = 0; axis < 3; ++axis) {
    twice += (free_inertia_.array() * (x.col(axis) - y_.col(axis)).array().square()).sum();
  }
  return twice / 2;
}

double StepObjective::rounding(double value) const {
  return units * unit * (value + std::sqrt(2 * value * scale_)) + unit * cancelling_;
}

double StepObjective::error_bound(const Vertices& gradient) const {
  const auto length =
      gradient.col(0).array().square() + gradient.col(1).array().square() + gradient.col(2).array().square();
  return std::sqrt((push_.array().square() * length).maxCoeff());
}

double StepObjective::error_rounding() const {
  constexpr double several = 64;  // measured: Newton's method ends at 0.1 to 2 of one, L-BFGS at up to 160
  return several * unit * stiffness_ratio_ * y_.cwiseAbs().maxCoeff();
}

}  // namespace drape
