#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "sim/parallel/threads.hpp"
#include "sim/parallel/vectors.hpp"
#include "sim/solvers/local_global.hpp"
#include "sim/solvers/newton.hpp"

namespace drape {

/// The last few curvature pairs s = Δx, q = Δ∇g of a minimisation. Computes the L-BFGS direction from them and an
/// initial inverse Hessian γA⁻¹. As A⁻¹∇g is known at every point, A⁻¹q is kept instead of q. The two-loop recursion
/// (Nocedal and Wright 2006, algorithm 7.4) runs on inner products of the pairs instead of vectors. An iteration reads
/// the kept vectors twice, for any number of pairs, and solves with A once.
class LbfgsHistory {
 public:
  /// Number of pairs. Iterations to Newton's accuracy with 1, 3, 5, 8 pairs: 43, 40, 40, 39 (20×20, k = 180, ε = 1e-3).
  static constexpr int capacity = 4;

  /// @param threads shared by its passes; must outlive it
  explicit LbfgsHistory(int vertex_count, const Threads& threads = one_thread());

  void clear();

  /// Stores ∇g and A⁻¹∇g at the present point, and completes the pair of the last move.
  void observe(const Vertices& gradient, const Vertices& preconditioned);

  /// Computes direction = H⁻¹∇g at the observed point.
  void find_direction(const Vertices& preconditioned, Vertices& direction) const;

  /// Stores the move from the observed point by −length·direction, where ∇g·direction is `slope`.
  void moved(const Vertices& direction, double length, double slope);

 private:
  /// A pair with its inner products with the gradient at the observed point and with all pairs, by slot.
  struct Pair {
    Vertices step;            // s
    Vertices preconditioned;  // A⁻¹q
    double step_gradient = 0, preconditioned_gradient = 0;
    std::array<double, capacity> step_change{};            // s·q of every other pair
    std::array<double, capacity> preconditioned_change{};  // A⁻¹q·q of every other pair
  };

  /// Returns pair k; 0 is the oldest.
  [[nodiscard]] Pair& pair(int k) { return pairs_[slot(k)]; }
  [[nodiscard]] const Pair& pair(int k) const { return pairs_[slot(k)]; }
  [[nodiscard]] std::size_t slot(int k) const { return order_[static_cast<std::size_t>(k)]; }
  [[nodiscard]] Pair& newest() { return pair(count_ - 1); }
  void measure(const Vertices& gradient);

  const Threads& threads_;
  std::array<Pair, capacity> pairs_;
  std::array<std::size_t, capacity> order_{};  // all slots: used ones from the oldest, then free ones
  int count_ = 0;                              // number of pairs
  bool pending_ = false;                       // the newest pair lacks its change of gradient
  Vertices last_preconditioned_;               // A⁻¹∇g at the observed point
  double gradient_norm_ = 0;                   // ∇g·A⁻¹∇g at that point
};

/// L-BFGS on g with Liu13's matrix A as the initial Hessian (Liu, Bouaziz and Kavan, "Quasi-Newton Methods for
/// Real-Time Simulation of Hyperelastic Materials", 2017, section 4). Each iteration scales A to the last curvature
/// (Nocedal and Wright 2006, eq. 7.20), which saves a third of the iterations. A line search keeps g from rising.
///
/// Two changes apply to a fine cloth with the error rule. If only springs hold the cloth together, some iterations use
/// Newton's method on patches (PatchNewton), as few vertices exceed the tolerance after some iterations. Others are
/// Newton steps on the whole cloth, by a few conjugate gradients. They estimate the distance from the minimum when the
/// gradient does not, see docs/notes/accuracy.md.
class QuasiNewton final : public FactoredMinimiser {
 public:
  QuasiNewton(const System& system, const StepObjective& objective, const IntegratorSettings& settings);

 private:
  void start() override;
  double iterate(Iterate& point) override;
  // Runs an iteration of another kind if one is due; returns the length of the point's move [m].
  double settle_patches(Iterate& point);
  double take_newton_step(Iterate& point);

  LbfgsHistory history_;
  Vertices preconditioned_;  // A⁻¹∇g at the point
  Vertices direction_;
  bool looks_ = false;   // true if some iterations are Newton steps
  int before_look_ = 0;  // number of other iterations before the first Newton step
  int until_look_ = 0;   // number of other iterations before the next Newton step
  int gap_ = 0;          // number of other iterations between the next two Newton steps
  std::optional<PatchNewton> patches_;
  int wait_ = 0;   // number of iterations until the next patch iteration
  int round_ = 0;  // number of consecutive patch iterations so far
};

}  // namespace drape
