#include "sim/schemes/push_limit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace drape {

PushLimit::PushLimit(const System& system) : weight_(system.cloth.masses.cwiseInverse()) {
  const Eigen::Index count = weight_.size();
  for (const int pin : system.cloth.pins) weight_[pin] = 0;
  for (const auto& energy : system.energies) {
    if (energy->internal()) continue;
    StiffnessBound bound{.vertices = Eigen::VectorXd::Zero(count)};
    energy->add_bound(bound);
    pushes_.push_back({energy.get(), std::move(bound.vertices), Vertices::Zero(count, 3), Vertices::Zero(count, 3)});
  }
  gradient_.resize(count, 3);
}

void PushLimit::begin(const Vertices& x, double time) {
  for (Push& push : pushes_) {
    push.held.setZero();
    push.mean.setZero();
    push.energy->add_gradient(x, time, push.held);
  }
}

void PushLimit::add(const Vertices& x, double time, double share) {
  for (Push& push : pushes_) {
    gradient_.setZero();
    push.energy->add_gradient(x, time, gradient_);
    push.mean += share * gradient_;
  }
}

void PushLimit::limit(double start, double end, Vertices& v) const {
  const double h = end - start;
  for (const Push& push : pushes_) {
    const Eigen::RowVector3d drift = push.energy->displacement(start, end).transpose() / h;
    for (Eigen::Index i = 0; i < v.rows(); ++i) {
      const double force = push.mean.row(i).norm();
      if (weight_[i] == 0 || force == 0) continue;
      const Eigen::RowVector3d away = -push.mean.row(i) / force;
      const double after = away.dot(v.row(i) - drift), before = after - h * weight_[i] * force;
      const double given = weight_[i] * push.held.row(i).squaredNorm() / push.bound[i];  // 2E/m [m²/s²]
      const double most = std::sqrt(std::pow(std::max(0.0, before), 2) + given);
      if (after > most) v.row(i) -= (after - most) * away;
    }
  }
}

}  // namespace drape
