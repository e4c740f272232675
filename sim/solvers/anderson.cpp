#include "sim/solvers/anderson.hpp"

#include <Eigen/QR>

namespace drape {
namespace {

constexpr double most_growth = 2;          // of the residual
constexpr double most_extrapolation = 10;  // relative to the change F(u) − u

}  // namespace

Eigen::VectorXd AndersonAcceleration::next(const Eigen::VectorXd& u, const Eigen::VectorXd& reached,
                                           const Eigen::VectorXd& weights) {
  const Eigen::VectorXd change = reached - u, residual = weights.cwiseProduct(change);
  const bool known = !history_.empty() && history_.back().residual.size() == residual.size();
  if (!known || residual.norm() > most_growth * history_.back().residual.norm()) restart();
  history_.push_back({reached, residual});
  const auto count = static_cast<Eigen::Index>(history_.size()) - 1;
  if (count == 0) return reached;
  Eigen::MatrixXd of_reached(u.size(), count), of_residual(u.size(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Iterate &before = history_[static_cast<std::size_t>(i)], &after = history_[static_cast<std::size_t>(i) + 1];
    of_reached.col(i) = after.reached - before.reached;
    of_residual.col(i) = after.residual - before.residual;
  }
  if (history_.size() > depth_) history_.pop_front();
  const Eigen::VectorXd extrapolation = -of_reached * of_residual.colPivHouseholderQr().solve(residual);
  if (!(extrapolation.norm() <= most_extrapolation * change.norm())) return reached;
  return reached + extrapolation;
}

AndersonIteration::AndersonIteration(Eigen::Index unknowns) {
  for (Pair& pair : pairs_) pair.residual = pair.c = Vertices::Zero(unknowns, 3);
  last_residual_ = last_c_ = best_residual_ = best_c_ = Vertices::Zero(unknowns, 3);
}

void AndersonIteration::clear() {
  count_ = oldest_ = 0;
  length_ = 1;
  begun_ = false;
}

void AndersonIteration::observe(const Vertices& residual, const Vertices& c) {
  constexpr double dependent = 1e-6;  // relative norm of a difference that the others span
  Pair& added = pairs_[(oldest_ + count_) % most_pairs];
  if (count_ == most_pairs) {
    oldest_ = (oldest_ + 1) % most_pairs;
    --count_;
  }
  added.residual = residual - last_residual_;
  added.c = c - last_c_;
  const double before = added.residual.norm();
  for (std::size_t k = 0; k < count_; ++k) {
    const Pair& kept = pairs_[(oldest_ + k) % most_pairs];
    const double share = kept.residual.cwiseProduct(added.residual).sum();
    added.residual -= share * kept.residual;
    added.c -= share * kept.c;
  }
  const double length = added.residual.norm();
  if (!(length > dependent * before)) return;
  added.residual /= length;
  added.c /= length;
  ++count_;
}

bool AndersonIteration::advance(const Vertices& residual, Vertices& c) {
  constexpr double grown = 10;  // allows for the initial growth of an iteration that does not contract
  const double norm = residual.norm();
  if (begun_ && !(norm <= grown * best_)) {
    count_ = oldest_ = 0;
    length_ /= 2;
    c = best_c_ + length_ * best_residual_;
    last_residual_ = best_residual_;
    last_c_ = best_c_;
    return false;
  }
  if (begun_) observe(residual, c);
  if (!begun_ || norm < best_) {
    best_ = norm;
    best_residual_ = residual;
    best_c_ = c;
  }
  begun_ = true;
  last_residual_ = residual;
  last_c_ = c;
  c += residual;
  for (std::size_t k = 0; k < count_; ++k) {
    const Pair& pair = pairs_[(oldest_ + k) % most_pairs];
    const double share = pair.residual.cwiseProduct(residual).sum();
    c -= share * (pair.c + pair.residual);
  }
  return true;
}

}  // namespace drape
