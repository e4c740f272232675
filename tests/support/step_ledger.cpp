#include "tests/support/step_ledger.hpp"

#include <algorithm>
#include <cmath>

#include "drape/sim/solvers/accuracy.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"

namespace drape::test {
namespace {

Real squared(const RealVertices& v, const Eigen::Matrix<Real, Eigen::Dynamic, 1>& weights) {
  return weights.dot(v.rowwise().squaredNorm());
}

}  // namespace

Real StepBalance::gain_rounding() const {
  return energy_rounding + kinetic_rounding +
         16 * unit * (kinetic_before + kinetic_after + inertial_loss + std::abs(work) + std::abs(imbalance));
}

StepLedger::StepLedger(const SimulationSettings& settings)
    : settings_(settings), system_(make_system(settings)), masses_(settings.cloth.masses.cast<Real>()) {
  for (const int pin : settings.cloth.pins) masses_[pin] = 0;
}

RealVertices StepLedger::force(const State& state, double part) const {
  Vertices sum = Vertices::Zero(state.x.rows(), 3);
  State then = state;
  then.x += part * settings_.step * state.v;
  for (const auto& force : system_.forces) {
    force->add(then, (static_cast<double>(state.step) + part) * settings_.step, sum);
  }
  for (const int pin : settings_.cloth.pins) sum.row(pin).setZero();
  return sum.cast<Real>();
}

StepLedger::Value StepLedger::value_of(const Vertices& x, double time) const {
  Value value;
  value.gradient = RealVertices::Zero(x.rows(), 3);
  Real squares = 0;
  for (const Spring& s : system_.springs) {
    const Eigen::Matrix<Real, 1, 3> d = x.row(s.i).cast<Real>() - x.row(s.j).cast<Real>();
    const Real length = d.norm(), stretch = length - s.rest_length;
    // A double locates the ends to half a unit of their distance from the origin.
    const Real rounding = unit * (x.row(s.i).norm() + x.row(s.j).norm() + s.rest_length);
    value.elastic += Real(0.5) * s.stiffness * stretch * stretch;
    value.energy_rounding += s.stiffness * (std::abs(stretch) + rounding) * rounding;
    // For a compressed spring rounding changes mainly the direction of its force.
    const Real turned = length > 0 ? std::min(Real(1), rounding / length) * std::abs(stretch) : 0;
    squares += s.stiffness * s.stiffness * (rounding + turned) * (rounding + turned);
    if (length == 0) continue;
    value.gradient.row(s.i) += s.stiffness * stretch / length * d;
    value.gradient.row(s.j) -= s.stiffness * stretch / length * d;
  }
  value.gradient_rounding = 4 * std::sqrt(squares);
  value.energy = value.elastic;
  Vertices others = Vertices::Zero(x.rows(), 3);
  for (const auto& energy : system_.energies) value.energy += energy->add_gradient(x, time, others);
  value.gradient += others.cast<Real>();
  value.gradient_rounding += 4 * unit * others.norm();
  value.energy_rounding += 4 * unit * (value.energy + others.norm() * x.norm());
  // Bending is a sum over pairs of stiffnesses of either sign, which cancel in a flat cloth.
  StiffnessBound bound{.pairs = {}, .vertices = Eigen::VectorXd::Zero(x.rows())};
  for (const auto& energy : system_.energies) energy->add_bound(bound);
  for (const Spring& pair : bound.pairs) {
    value.energy_rounding += 4 * unit * std::abs(pair.stiffness) / 2 * (x.row(pair.i) - x.row(pair.j)).squaredNorm();
  }
  for (const int pin : settings_.cloth.pins) value.gradient.row(pin).setZero();
  return value;
}

RealVertices StepLedger::aim(const State& before) const {
  const Real h = settings_.step;
  RealVertices y = before.x.cast<Real>();
  const RealVertices f = force(before);
  for (Eigen::Index i = 0; i < y.rows(); ++i) {
    if (masses_[i] > 0) y.row(i) += h * before.v.row(i).cast<Real>() + h * h / masses_[i] * f.row(i);
  }
  return y;
}

Real StepLedger::work_at(double part, const State& before, const State& after) const {
  return std::abs(force(before, part).cwiseProduct(after.x.cast<Real>() - before.x.cast<Real>()).sum());
}

Real StepLedger::resting_energy() const {
  Real scale = 0;
  for (const Spring& s : system_.springs) scale += Real(s.stiffness) * s.rest_length * s.rest_length;
  return unit * scale;
}

StepBalance StepLedger::balance(const State& before, const State& after) const {
  const Real h = settings_.step;
  const double end = static_cast<double>(after.step) * settings_.step;
  const RealVertices v = before.v.cast<Real>(), change = after.x.cast<Real>() - before.x.cast<Real>();
  const RealVertices w = change / h, gained = w - v, f = force(before), y = aim(before);
  const Value old_value = value_of(before.x, end), new_value = value_of(after.x, end);
  const Vertices start = y.cast<double>();
  const Value start_value = value_of(start, end);
  RealVertices gradient = masses_.asDiagonal() * gained / h - f + new_value.gradient;
  for (const int pin : settings_.cloth.pins) gradient.row(pin).setZero();

  StepBalance b;
  b.kinetic_before = squared(v, masses_) / 2;
  b.kinetic_after = squared(w, masses_) / 2;
  b.energy_before = old_value.energy;
  b.energy_after = new_value.energy;
  b.elastic_before = old_value.elastic;
  b.elastic_after = new_value.elastic;
  b.work = f.cwiseProduct(change).sum();
  b.inertial_loss = squared(gained, masses_) / 2;
  b.convexity_loss = old_value.energy - new_value.energy + new_value.gradient.cwiseProduct(change).sum();
  b.imbalance = gradient.cwiseProduct(change).sum();
  b.gradient_norm = gradient.norm();
  b.start_value = start_value.energy;
  b.end_value = squared(after.x.cast<Real>() - y, masses_) / (2 * h * h) + new_value.energy;
  const RealVertices reach = after.x.cast<Real>().cwiseAbs() + y.cwiseAbs() + before.x.cast<Real>().cwiseAbs();
  const Real inertia = (masses_.asDiagonal() * reach).norm() / (h * h);
  b.gradient_rounding = new_value.gradient_rounding + 4 * unit * inertia + 4 * unit * f.norm();
  b.energy_rounding =
      4 * (new_value.energy_rounding + old_value.energy_rounding + start_value.energy_rounding) +
      8 * unit * (b.start_value + b.end_value + b.energy_before) +
      8 * unit * std::sqrt(squared(reach, masses_) * squared(after.x.cast<Real>() - y, masses_)) / (h * h);
  // Sums over all vertices, which round more, conserve the momentum of a free cloth.
  b.kinetic_rounding = 128 * unit * std::sqrt(squared(reach, masses_) * squared(change, masses_)) / (h * h);
  b.tolerated = tolerated(b, f, change, tolerance(before, after));
  return b;
}

Real StepLedger::tolerance(const State& before, const State& after) const {
  const Accuracy accuracy(settings_.integrator, system_, system_.inertia(settings_.step));
  if (!accuracy.is_default) return accuracy.tolerance;
  Real whole = 0, by_forces = 0;
  for (Eigen::Index i = 0; i < before.x.rows(); ++i) {
    const Eigen::Matrix<Real, 1, 3> way = after.x.row(i).cast<Real>() - before.x.row(i).cast<Real>();
    if (masses_[i] == 0) continue;
    whole = std::max(whole, way.norm());
    by_forces = std::max(by_forces, (way - settings_.step * before.v.row(i).cast<Real>()).norm());
  }
  const Real rounding = 64 * unit * condition_bound(system_) * aim(before).cwiseAbs().maxCoeff();
  return std::max(std::min(by_forces / (accuracy.order == 1 ? 10 : 20), whole / 100), rounding);
}

Real StepLedger::tolerated(const StepBalance& b, const RealVertices& force, const RealVertices& change,
                           Real tolerance) const {
  Real way = 0, push = 0;
  for (Eigen::Index i = 0; i < change.rows(); ++i) {
    if (masses_[i] == 0) continue;
    way += change.row(i).squaredNorm();
    push += force.row(i).squaredNorm() / masses_[i];
  }
  const Accuracy accuracy(settings_.integrator, system_, system_.inertia(settings_.step));
  if (accuracy.rule == StoppingRule::gradient) return tolerance * std::sqrt(way);
  if (accuracy.rule == StoppingRule::error) {
    const Real h = settings_.step;
    return tolerance * masses_.dot(change.rowwise().norm()) / (h * h);
  }
  const Real most = settings_.step * std::sqrt(push) * std::sqrt(2 * b.kinetic_after);
  return std::min(most / 10, std::max(b.inertial_loss, -b.work));
}

Eigen::Matrix<Real, 1, 3> StepLedger::momentum(const State& state) const {
  return masses_.transpose() * state.v.cast<Real>();
}

Real StepLedger::momentum_scale(const State& state) const { return masses_.dot(state.v.cast<Real>().rowwise().norm()); }

}  // namespace drape::test
