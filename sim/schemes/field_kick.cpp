#include "sim/schemes/field_kick.hpp"

#include <Eigen/LU>

#include <limits>

namespace drape {
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
        const Eigen::Matrix3d& slope = slopes_.velocity_forces()[static_cast<std::size_t>(i)];
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
