#pragma once

#include <Eigen/Core>
#include <limits>

#include "drape/sim/simulation.hpp"
#include "sim/system.hpp"

namespace drape::test {

using Real = long double;
/// Distance from 1 to the next double.
inline constexpr Real unit = std::numeric_limits<double>::epsilon();
using RealVertices = Eigen::Matrix<Real, Eigen::Dynamic, 3>;

/// Energy balance of a step of implicit Euler, computed from the states before and after it in extended precision,
/// literally by its formulas. With Δx = x' − x, w = Δx/h (the velocity before damping) and Δv = w − v,
///   ∇g = M Δv/h − f + ∇E(x'),
/// and its inner product with Δx is the energy balance of the step,
///   ΔK + ΔE = W_ext − ½‖Δv‖²_M − B + ∇g·Δx,   B = E(x) − E(x') − ∇E(x')·(x − x').
/// E is the energy of everything that the step solves for, at the step's end.
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
  /// Energy that the step may gain if it met its tolerance [J]: with a gradient, tolerance·‖Δx‖; with an error δ,
  /// Σ m/h² δ ‖Δxᵢ‖; with a change, a tenth of ‖h M⁻¹f‖_M ‖w‖_M, bounded by the inertial loss and by −W_ext.
  Real tolerated = 0;
  /// Greatest change of ‖∇g‖ [N], of E and g, and of K [J] by one rounding of every position.
  Real gradient_rounding = 0, energy_rounding = 0, kinetic_rounding = 0;

  /// Returns ΔK + ΔE − W_ext [J].
  [[nodiscard]] Real gain() const { return kinetic_after - kinetic_before + energy_after - energy_before - work; }
  /// Returns the rounding error of gain() [J].
  [[nodiscard]] Real gain_rounding() const;
};

/// Energy balance of a simulation's steps, computed independently of the simulation.
class StepLedger {
 public:
  /// @param settings must outlive this object
  explicit StepLedger(const SimulationSettings& settings);

  [[nodiscard]] StepBalance balance(const State& before, const State& after) const;
  /// Returns Σ m v [kg m/s]; momentum_scale() returns Σ m ‖v‖ for comparison.
  [[nodiscard]] Eigen::Matrix<Real, 1, 3> momentum(const State& state) const;
  [[nodiscard]] Real momentum_scale(const State& state) const;

  /// Returns |f·Δx|, the work of the forces in a step of an explicit method [J]. It evaluates them where the cloth is
  /// after `part` of the step at its first velocity.
  [[nodiscard]] Real work_at(double part, const State& before, const State& after) const;
  /// Returns the allowed residual of a step's solve, an error [m] or a force [N], by the rule of [integrator]; computed
  /// here from the states before and after it.
  [[nodiscard]] Real tolerance(const State& before, const State& after) const;
  /// Returns the rounding error of the energy of a cloth at rest, ε Σ k L² [J].
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
  Eigen::Matrix<Real, Eigen::Dynamic, 1> masses_;  // 0 for pins
};

}  // namespace drape::test
