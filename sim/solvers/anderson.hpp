#pragma once

#include <Eigen/Core>
#include <deque>

namespace drape {

/// Anderson acceleration of a fixed-point iteration u ← F(u) (Anderson 1965; Walker and Ni 2011, in the form of
/// differences). The residuals w·(F(u) − u) of the last iterates are combined to the smallest one, in least squares,
/// and the next u is the same combination of their F(u). This ends oscillations that die out slowly. The history is
/// forgotten when the number of unknowns changes, and after a residual that has grown to more than twice the last one.
/// A next u that is more than ten times as far from F(u) as u is noise, and replaced by F(u).
class AndersonAcceleration {
 public:
  /// @param depth number of earlier iterates used, at least 1
  explicit AndersonAcceleration(std::size_t depth) : depth_(depth) {}

  /// Forgets all iterates.
  void restart() { history_.clear(); }
  /// Returns the next u.
  /// @param u present iterate @param reached F(u) @param weights w, of each unknown
  Eigen::VectorXd next(const Eigen::VectorXd& u, const Eigen::VectorXd& reached, const Eigen::VectorXd& weights);

 private:
  struct Iterate {
    Eigen::VectorXd reached, residual;
  };
  std::size_t depth_;
  std::deque<Iterate> history_;  // oldest first
};

}  // namespace drape
