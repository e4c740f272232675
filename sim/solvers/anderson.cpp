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

}  // namespace drape
