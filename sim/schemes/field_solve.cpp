#include "sim/schemes/field_solve.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace drape {
namespace {

constexpr int most_field_rounds = 60;
// Error of c, as a fraction of the solve's tolerance. A force error adds up over the steps, while a solve's error is
// corrected in the next one; another round costs only one or two iterations.
constexpr double share_of_tolerance = 0.01;
constexpr int rounds_with_a_slope = 8;
// Rounds after which the full tolerance suffices, as errors of the solves may exceed the fraction.
constexpr int thorough_rounds = 12;

}  // namespace

FieldSolve::FieldSolve(const System& system, const StepObjective& objective)
    : system_(system),
      objective_(objective),
      fields_(system),
      drag_(*system.drag),
      iteration_(system.cloth.vertex_count()) {}

void FieldSolve::begin(const State& from, double end) {
  const double t = objective_.duration();
  time_ = end;
  start_ = from.x;
  iteration_.clear();
  rounds_ = 0;
  over_ = converged_ = false;
  // Slopes and the first c use the positions predicted by the velocities.
  state_.x = from.x + t * from.v;
  system_.place_pins(end, state_.x);
  state_.v = from.v;
  drag_.begin(state_, end, start_);
  fields_.find(state_, end, c_);
  drag_.add_pull(state_.x, c_);
}

const Vertices& FieldSolve::force_with(const Vertices& others) {
  force_ = others + system_.cloth.masses.asDiagonal() * c_;
  return force_;
}

bool FieldSolve::improve(Vertices& x, const Minimiser& minimiser) {
  state_.x = x;
  state_.v = (x - start_) / objective_.duration();
  fields_.find(state_, time_, acceleration_);
  residual_ = acceleration_ - c_;
  drag_.add_pull(x, residual_);
  if (rounds_ == 0 && !residual_.allFinite()) {
    x.setConstant(std::numeric_limits<double>::quiet_NaN());
    return false;
  }
  converged_ = negligible(x, minimiser);
  if (converged_ || over_) return false;
  if (rounds_ == 0 || error_ < least_error_) {
    least_error_ = error_;
    best_c_ = c_;
    best_x_ = x;
  }
  if (++rounds_ < most_field_rounds) {
    advance(x);
    return true;
  }
  over_ = true;
  if (error_ == least_error_) return false;
  c_ = best_c_;
  x = best_x_;
  return true;
}

void FieldSolve::advance(Vertices& x) {
  const bool nearest = error_ == least_error_;
  if (nearest && rounds_ % rounds_with_a_slope == 1 && drag_.begin(state_, time_, start_)) {
    iteration_.clear();
    c_ = acceleration_;
    drag_.add_pull(x, c_);
    return;
  }
  before_ = c_;
  if (!iteration_.advance(residual_, c_)) {
    before_ = best_c_;
    x = best_x_;
  }
  before_ = c_ - before_;
  drag_.add_way(before_, x);  // a point within the tolerance of the next minimum would not be moved
}

bool FieldSolve::negligible(const Vertices& x, const Minimiser& minimiser) {
  const double t = objective_.duration();
  double rounding = 0;
  if (minimiser.accuracy().rule == StoppingRule::gradient) {
    error_ = (system_.cloth.masses.asDiagonal() * residual_).norm();
  } else {
    before_.setZero(x.rows(), 3);
    drag_.add_way(residual_, before_);
    error_ = before_.rowwise().norm().maxCoeff();
    constexpr double several = 64;
    rounding = several * std::numeric_limits<double>::epsilon() *
               (x.cwiseAbs().maxCoeff() + t * t * acceleration_.cwiseAbs().maxCoeff());
  }
  if (error_ <= std::max(share_of_tolerance * minimiser.tolerance(), rounding)) return true;
  return rounds_ >= thorough_rounds && error_ <= minimiser.tolerance();
}

const Vertices& FieldSolve::end() {
  drag_.end();
  force_ = system_.cloth.masses.asDiagonal() * acceleration_;
  return force_;
}

namespace {

constexpr double relative_error = 1e-12;  // of the speeds
constexpr double contraction = 0.1;       // ratio of successive errors above which the iteration uses slopes
constexpr int most_kick_iterations = 40;

double largest_speed(const Vertices& v) { return v.rowwise().norm().maxCoeff(); }

}  // namespace

FieldKick::FieldKick(const System& system) : system_(system), fields_(system), slopes_(system) {}

void FieldKick::find_acceleration(const Vertices& before, const Vertices& w, double time) {
  state_.v = (before + w) / 2;
  fields_.find(state_, time, acceleration_);
}

bool FieldKick::kick(const Vertices& x, double time, const Vertices& before, Vertices& v) {
  const double h = system_.step;
  state_.x = x;
  w_ = v;
  bool sloped = false, found = false;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most_kick_iterations && !found; ++k) {
    find_acceleration(before, w_, time);
    missing_ = v + h * acceleration_ - w_;
    if (sloped) {
      for (Eigen::Index i = 0; i < missing_.rows(); ++i) {
        const Eigen::Matrix3d& slope = slopes_.by_velocity()[static_cast<std::size_t>(i)];
        const Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity() - h / 2 * slope;
        missing_.row(i) = matrix.partialPivLu().solve(missing_.row(i).transpose().eval()).transpose();
      }
    }
    w_ += missing_;
    const double change = largest_speed(missing_);
    found = change <= relative_error * largest_speed(w_);
    if (!found && !(change < contraction * last)) {
      state_.v = (before + w_) / 2;
      slopes_.find(state_, time);
      sloped = true;
    }
    last = change;
  }
  v = w_;
  force_ = system_.cloth.masses.asDiagonal() * acceleration_;
  return found;
}

}  // namespace drape
