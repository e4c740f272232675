#pragma once

#include <memory>

#include "sim/dashpots.hpp"

namespace drape {

/// Dissipation potential of dashpots in an implicit step of τ seconds, P = 1/(2τ) (x − x₀)ᵀ C (x − x₀). Its gradient is
/// C v with v = (x − x₀)/τ. C has constant directions in the step, so P is convex and quadratic, and every solver has
/// its exact Hessian. The dashpots dissipate 2 P.
class StepDissipation final : public Energy {
 public:
  /// @param shortest least τ of any step [s], for add_bound()
  /// @param start    first x₀, n×3 [m]
  /// @param threads  for its passes; must outlive this
  StepDissipation(std::shared_ptr<Dashpots> dashpots, double shortest, const Vertices& start,
                  const Threads& threads = one_thread());

  /// Begins a step of `duration` seconds from `start`, with directions at other positions, both n×3 [m].
  void begin(const Vertices& directions_at, const Vertices& start, double duration);
  /// Returns P(x) [J].
  [[nodiscard]] double value(const Vertices& x) const;

  double add_gradient(const Vertices& x, double time, Vertices& gradient) const override;
  void add_bound(StiffnessBound& bound) const override { dashpots_->add_bound(1 / shortest_, bound); }
  [[nodiscard]] std::unique_ptr<EnergyHessian> make_hessian() const override;
  [[nodiscard]] bool stored() const override { return false; }

 private:
  class Hessian;

  /// Sets product_ = C (x − x₀)/τ and returns P.
  double evaluate(const Vertices& x) const;

  std::shared_ptr<Dashpots> dashpots_;
  const Threads& threads_;
  double shortest_, duration_;
  Vertices start_;
  mutable Vertices way_, product_;  // scratch: (x − x₀)/τ [m/s]; [N]
};

}  // namespace drape
