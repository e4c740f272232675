#include "sim/linear/hessian_diagonal.hpp"

#include <algorithm>

#include "sim/parallel/loops.hpp"

namespace drape {

HessianDiagonal::HessianDiagonal(const System& system, const StepObjective& objective)
    : objective_(objective), scalar_(objective.inertia()), factor_(system.cloth.vertex_count(), 6) {
  const StiffnessBound bound = system.stiffness_bound();
  scalar_ += bound.vertices;
  for (const Spring& pair : bound.pairs) add_row_sums(pair, scalar_);
}

void HessianDiagonal::linearise(const SpringNetwork::Blocks& springs) {
  factor_.setZero();
  objective_.springs().add_diagonal(springs, factor_);
  for_ranges(objective_.threads(), factor_.rows(), [&](Eigen::Index first, Eigen::Index count) {
    for (Eigen::Index i = first; i < first + count; ++i) {
      // Up to rounding, no pivot is below the isotropic part.
      const double least = scalar_[i], xx = least + 2 * factor_(i, 0);
      const double xy = 2 * factor_(i, 1) / xx, xz = 2 * factor_(i, 2) / xx;
      const double yy = std::max(least, least + 2 * (factor_(i, 3) - xy * factor_(i, 1)));
      const double yz = 2 * (factor_(i, 4) - xy * factor_(i, 2)) / yy;
      const double zz = std::max(least, least + 2 * (factor_(i, 5) - xz * factor_(i, 2)) - yz * yz * yy);
      factor_.row(i) << 1 / xx, xy, xz, 1 / yy, yz, 1 / zz;
    }
  });
}

void HessianDiagonal::add_solution(const Vertices& b, Vertices& x) const {
  for_ranges(objective_.threads(), x.rows(), [&](Eigen::Index first, Eigen::Index count) {
    for (Eigen::Index i = first; i < first + count; ++i) {
      const double xy = factor_(i, 1), xz = factor_(i, 2), yz = factor_(i, 4);
      const double below = b(i, 1) - xy * b(i, 0), last = b(i, 2) - xz * b(i, 0) - yz * below;
      const double z = factor_(i, 5) * last;
      const double y = factor_(i, 3) * below - yz * z;
      x(i, 0) += factor_(i, 0) * b(i, 0) - xy * y - xz * z;
      x(i, 1) += y;
      x(i, 2) += z;
    }
  });
}

}  // namespace drape
