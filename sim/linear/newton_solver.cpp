#include "sim/linear/newton_solver.hpp"

#include <algorithm>
#include <cmath>

#include "sim/parallel/loops.hpp"
#include "sim/parallel/vectors.hpp"

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

namespace {

// A smaller residual helps Newton's method only near convergence to rounding. The iteration counts of the homework's
// tables are kept.
constexpr double tolerance = 1e-2;
// An estimate for a fine cloth ends at a small residual, or when the solution has grown by less than the second
// fraction in a few iterations. Its length converges long before its stiff parts do.
constexpr double tolerance_of_estimates = 0.1, growth_of_estimates = 0.05;
constexpr std::size_t growing = 4;

// Relative costs, measured in nanoseconds on one machine: grids of 10×10 to 100×100 cells and irregular meshes of 1400
// and 4000 vertices, with and without bending. They agree within a third.
// Costs in an iteration: a number of A's factor, a pair in a band, a pair accessed by index, a vertex, and its block of
// D, including its assembly.
constexpr double of_number = 0.35, of_pair = 1.2, of_gathered_pair = 10, of_vertex = 4, of_block = 2.5;
// Costs of H's factor: an operation, an entry of L, and the assembly of a pair.
constexpr double of_operation = 0.015, of_entry = 2.5, of_assembled_pair = 130;

}  // namespace

ConjugateGradients::ConjugateGradients(const System& system, const StepObjective& objective,
                                       ConstantFactor* preconditioner)
    : system_(system),
      objective_(objective),
      own_(preconditioner == nullptr
               ? std::make_unique<ConstantFactor>(system, objective.duration(), Precision::automatic)
               : nullptr),
      preconditioner_(preconditioner == nullptr ? *own_ : *preconditioner),
      tolerance_(tolerance),
      residual_(Vertices::Zero(system.cloth.vertex_count(), 3)),
      preconditioned_(residual_),
      search_(residual_),
      product_(residual_) {
  pair_count_ = system.stiffness_bound().pair_count();
  for (const auto& energy : system.energies) hessians_.push_back(energy->make_hessian());
  if (FreeVertices(system.cloth).count() < fine_cloth) return;
  diagonal_.emplace(system, objective);
  estimates_ = preconditioner != nullptr;
  if (estimates_) tolerance_ = tolerance_of_estimates;
}

bool ConjugateGradients::solve_within(int iterations, const Vertices& x, const Vertices& gradient, double concavity,
                                      Vertices& direction) {
  const Threads& threads = objective_.threads();
  linearise(x, concavity);
  set_zero(threads, direction);
  copy(threads, gradient, residual_);
  const double enough = tolerance_ * norm(threads, gradient);
  lengths_.clear();
  double energy = 0;  // residual · A⁻¹ residual
  for (int iteration = 0; norm(threads, residual_) > enough; ++iteration) {
    if (iteration == iterations) return false;
    system_.stop.check();
    precondition();
    const double before = energy;
    energy = dot(threads, residual_, preconditioned_);
    if (iteration == 0) {
      copy(threads, preconditioned_, search_);
    } else {
      multiply_and_add(threads, energy / before, preconditioned_, search_);
    }
    apply(search_, product_);
    const double curvature = dot(threads, search_, product_);
    if (concavity > 0 && !(curvature > 0)) {
      // It has been solved as far as H is positive definite (Nocedal and Wright 2006, algorithm 7.1).
      if (iteration == 0) direction = preconditioned_;
      return true;
    }
    const double length = energy / curvature;
    if (!std::isfinite(length)) return true;
    add_multiple(threads, length, search_, direction);
    add_multiple(threads, -length, product_, residual_);
    if (estimates_ && has_stagnated(direction)) return true;
  }
  return true;
}

int ConjugateGradients::worth_a_factor() const {
  const SpringNetwork& springs = objective_.springs();
  const double gathered =
      static_cast<double>(springs.gathered()) / std::max(1.0, static_cast<double>(springs.springs().size()));
  const auto entries = static_cast<double>(preconditioner_.entries());
  const auto pairs = static_cast<double>(pair_count_), vertices = static_cast<double>(residual_.rows());
  const double iteration = of_number * entries + (diagonal_ ? of_vertex + of_block : of_vertex) * vertices +
                           (gathered * of_gathered_pair + (1 - gathered) * of_pair) * pairs;
  // H has 3×3 blocks for each entry of A: three times the columns, with three times the entries each.
  const double factor =
      27 * of_operation * preconditioner_.operations() + 9 * of_entry * entries + of_assembled_pair * pairs;
  return static_cast<int>(std::min(std::ceil(factor / std::max(iteration, 1.0)), 1e9));
}

void ConjugateGradients::linearise(const Vertices& x, double concavity) {
  objective_.springs().compute_blocks(x, concavity, blocks_);
  for (const auto& hessian : hessians_) hessian->linearise(x, objective_.time(), concavity);
  if (diagonal_) diagonal_->linearise(blocks_);
}

bool ConjugateGradients::has_stagnated(const Vertices& direction) {
  lengths_.push_back(norm(objective_.threads(), direction));
  return lengths_.size() > growing &&
         lengths_.back() < (1 + growth_of_estimates) * lengths_[lengths_.size() - 1 - growing];
}

void ConjugateGradients::precondition() {
  preconditioner_.solve(residual_, preconditioned_);
  if (diagonal_) diagonal_->add_solution(residual_, preconditioned_);
}

void ConjugateGradients::apply(const Vertices& vector, Vertices& product) const {
  weigh(objective_.threads(), objective_.inertia(), vector, product);
  objective_.springs().add_product(blocks_, vector, product);
  for (const auto& hessian : hessians_) hessian->add_product(vector, product);
  for (const int pin : system_.cloth.pins) product.row(pin).setZero();
}

}  // namespace drape
