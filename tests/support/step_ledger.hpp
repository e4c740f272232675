#pragma once

#include <Eigen/Core>
#include <limits>

#include "sim/simulation.hpp"
#include "sim/system.hpp"

namespace drape::test {

using Real = long double;
/// From 1 to the next double.
inline constexpr Real unit = std::numeric_limits<double>::epsilon();
using RealVertices = Eigen::Matrix<Real, Eigen::Dynamic, 3>;

/// What a step of implicit Euler did, computed from the states before and after it in extended precision and as the
/// formulas are written. With Δx = x' − x, w = Δx/h (the velocity before damping) and Δv = w − v,
///   ∇g = M Δv/h − f + ∇E(x'),
/// and its inner product with Δx is the energy balance of the step,
///   ΔK + ΔE = W_ext − ½‖Δv‖²_M − B + ∇g·Δx,   B = E(x) − E(x') − ∇E(x')·(x − x').
/// E is everything that the step solves for, at the time when it ends.
struct StepBalance {
  Real kinetic_before = 0, kinetic_after = 0;  ///< K, of v and w [J]
  Real energy_before = 0, energy_after = 0;    ///< E [J]
  Real elastic_before = 0, elastic_after = 0;  ///< of the springs alone [J]
  Real work = 0;                               ///< W_ext = f·Δx [J]
  Real inertial_loss = 0;                      ///< ½‖Δv‖²_M [J]
  Real convexity_loss = 0;                     ///< B, negative where E is concave [J]
  Real imbalance = 0;                          ///< ∇g·Δx [J]
  Real gradient_norm = 0;                      ///< ‖∇g‖ [N]
  Real start_value = 0, end_value = 0;         ///< g(y) and g(x') [J]
  /// What the step may gain if it met its tolerance [J]: at a gradient, tolerance·‖Δx‖; at an error δ,
  /// Σ m/h² δ ‖Δxᵢ‖; at a change, a tenth of
  /// ‖h M⁻¹f‖_M ‖w‖_M, and no more than the inertial loss or than the forces took, −W_ext.
  Real tolerated = 0;
  /// What one rounding of every position changes at most in ‖∇g‖ [N], in E and g, and in K [J].
  Real gradient_rounding = 0, energy_rounding = 0, kinetic_rounding = 0;

  /// ΔK + ΔE − W_ext [J].
  [[nodiscard]] Real gain() const { return kinetic_after - kinetic_before + energy_after - energy_before - work; }
  /// What rounding can make of it [J].
  [[nodiscard]] Real gain_rounding() const;
};

/// Keeps books of the steps of a simulation, from its own knowledge of what acts on the cloth.
class StepLedger {
 public:
  /// @param settings must outlive it
  explicit StepLedger(const SimulationSettings& settings);

  [[nodiscard]] StepBalance balance(const State& before, const State& after) const;
  /// Σ m v, and Σ m ‖v‖ to compare it with [kg m/s].
  [[nodiscard]] Eigen::Matrix<Real, 1, 3> momentum(const State& state) const;
  [[nodiscard]] Real momentum_scale(const State& state) const;

  /// |f·Δx|, what the forces did in a step of an explicit method, which evaluates them where the cloth is after this
  /// part of the step by its first velocity [J].
  [[nodiscard]] Real work_at(double part, const State& before, const State& after) const;
  /// What the solve of a step might leave, an error [m] or a force [N], by the rule that [integrator] has: computed
  /// here from where the step began and ended.
  [[nodiscard]] Real tolerance(const State& before, const State& after) const;
  /// What rounding leaves of the energy of a cloth at rest, ε Σ k L² [J].
  [[nodiscard]] Real resting_energy() const;

 private:
  struct Value {
    Real energy = 0, elastic = 0, energy_rounding = 0, gradient_rounding = 0;
    RealVertices gradient;
  };
  [[nodiscard]] Value value_of(const Vertices& x, double time) const;
  [[nodiscard]] RealVertices force(const State& state, double part = 0) const;
  [[nodiscard]] RealVertices aim(const State& before) const;
  [[nodiscard]] Real tolerated(const StepBalance& b, const RealVertices& force, const RealVertices& change,
                               Real tolerance) const;

  const SimulationSettings& settings_;
  System system_;
  Eigen::Matrix<Real, Eigen::Dynamic, 1> masses_;  // 0 at pins
};

}  // namespace drape::test
