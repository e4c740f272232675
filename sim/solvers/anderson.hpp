#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <deque>

#include "drape/sim/mesh.hpp"

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

/// A fixed-point iteration c = T(c) with Anderson acceleration that also converges where T does not contract: if the
/// residual grows, it returns to the best point. AndersonAcceleration instead follows a T that changes.
///
/// Keeps the last few differences of the residuals T(c) − c in orthonormal form, together with the matching differences
/// of c, n×3. Inner products with these give the combination of least residual. For linear T this is the GCR method.
class AndersonIteration {
 public:
  /// @param unknowns n
  explicit AndersonIteration(Eigen::Index unknowns);

  /// Resets for another iteration.
  void clear();
  /// Replaces c, given its residual, by the next iterate. Returns false if it returned to the best point.
  bool advance(const Vertices& residual, Vertices& c);

 private:
  struct Pair {
    Vertices residual, c;  // differences
  };
  static constexpr std::size_t most_pairs = 12;

  /// Stores the difference of the last two points.
  void observe(const Vertices& residual, const Vertices& c);

  std::array<Pair, most_pairs> pairs_;
  std::size_t count_ = 0, oldest_ = 0;
  Vertices last_residual_, last_c_;  // of the last point, if begun_
  Vertices best_residual_, best_c_;  // of the point with the least residual, if begun_
  double best_ = 0;                  // norm of its residual
  double length_ = 1;                // step length from the best point after a return
  bool begun_ = false;
};

}  // namespace drape
