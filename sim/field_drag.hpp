#pragma once

#include "sim/field_slope.hpp"

namespace drape {

/// The part of what velocity fields do in an implicit step of τ seconds that has a potential and takes energy, as far
/// as it is linear. With v = (x − x₀)/τ the acceleration of a vertex changes by G = ∂a/∂v/τ + ∂a/∂x for each metre that
/// it goes further. The symmetric part of −G without its negative eigenvalues is that of a spring to where the step
/// began, E = ½ Σ m (x − x₀)ᵀQ(x − x₀), which is in g and so in every solver's Hessian: what a stiff drag stops does
/// not have to be found by iteration. FieldSolve takes into account what a and this differ by.
///
/// The antisymmetric part turns velocities, by α = τ²‖G − Gᵀ‖/2 in the step, and iterating for it multiplies errors by
/// iα where nothing else holds a vertex. With α²/(1 + α)/τ² in every direction of Q as well that is (s + iα)/(1 + s),
/// s = α²/(1 + α), which is below 1 for any α; small ones it leaves as they are.
///
/// Outside of a step Q is zero.
class FieldDrag final : public Energy {
 public:
  /// @param duration τ [s]
  /// @param bounded  whether Q stays below what it is at the start of the motion, for solvers that count on add_bound()
  FieldDrag(const System& system, double duration, bool bounded);

  /// Takes Q at a state and a time [s] for a step from `start`, n×3 [m]. Returns whether it is another than before.
  bool begin(const State& state, double time, const Vertices& start);
  /// Ends the step.
  void end() { q_.setZero(); }
  /// x += τ² (I + τ² Q)⁻¹ a: how far an acceleration a leads free vertices in the step, n×3 [m/s²].
  void add_way(const Vertices& acceleration, Vertices& x) const;
  /// acceleration += Q (x − x₀), n×3 [m/s²].
  void add_pull(const Vertices& x, Vertices& acceleration) const;

  double add_gradient(const Vertices& x, double time, Vertices& gradient) const override;
  void add_bound(StiffnessBound& bound) const override { bound.vertices += bound_; }
  [[nodiscard]] std::unique_ptr<EnergyHessian> make_hessian() const override;

 private:
  class Hessian;
  using Blocks = Eigen::Matrix<double, Eigen::Dynamic, 6>;

  /// Q of one vertex [1/s²].
  [[nodiscard]] Eigen::Matrix3d drag(std::size_t vertex, double most) const;

  const Eigen::VectorXd& masses_;
  double duration_;
  bool bounded_;
  FieldSlopes slopes_;
  Vertices start_;         // x₀
  Blocks q_, before_;      // Q as in HessianBlocks, and scratch [1/s²]
  Eigen::VectorXd bound_;  // of m Q at the start of the motion [N/m]
};

}  // namespace drape
