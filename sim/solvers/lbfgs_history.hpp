#pragma once

#include <array>
#include <cstddef>

#include "sim/kernels/vertices.hpp"
#include "sim/parallel/threads.hpp"

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

}  // namespace drape
