#pragma once

#include "sim/solvers/minimiser.hpp"
#include "sim/step_objective.hpp"

namespace drape {

/// Energy balance of a step of backward Euler. An iteration stops with a nonzero ∇g. With Δx = x' − x and v' = Δx/h the
/// energy changes by
///   ΔK + ΔE = W − ½‖v' − v‖²_M − B + ∇g·Δx,   B = E(x) − E(x') − ∇E(x')·(x − x'),
/// where W is the work of the forces (∇g written out, times Δx). A gain is possible if a step stops early (∇g·Δx) or if
/// springs end compressed, where E is concave (B < 0). Such a step continues even after its changes have become small.
/// At the iteration cap it is shortened towards x until it gains nothing. So a method far from its minimum, like liu13
/// with very stiff springs, or at a minimum of a crumpled cloth, loses energy and never gains any.
///
/// Dashpots add their dissipation potential P to g. It is zero at the start and dissipates 2 P, so the balance counts
/// half of the dissipation as energy of the cloth at the end of the step.
///
/// One gain is tolerated if the tolerance is met, since the homework's tolerances stop there. It is a tenth of the
/// largest work of the forces in a step, ‖h M⁻¹f‖_M ‖v'‖_M. In return the step must lose as much elsewhere, ½‖v' −
/// v‖²_M, or the forces must take as much, −W. This gain is proportional to the speed and independent of the cloth's
/// energy, so it cannot compound. The gradient rule tolerates the work of its residual, tolerance·‖Δx‖. The error rule,
/// with the error δ, tolerates that of its residual forces, Σ m/h² δ ‖Δxᵢ‖.
class EnergyBalance {
 public:
  EnergyBalance(const System& system, const StepObjective& objective, const Minimiser& minimiser);

  /// Stores the energy at the start of a step, whose y the objective has.
  /// @param state must not change until the step ends
  /// @param last_end positions passed to end() for the last step
  void begin(const State& state, const Vertices& last_end);
  /// Returns true if ΔK + ΔE − W at the point, minus the work of the contacts, exceeds rounding and the tolerated gain.
  /// With a given tolerance for errors, that is the work of their forces. By default it is the energy of displacements
  /// within the tolerance, ½ Σ m/h² δ², which does not grow with the speed, as default tolerances in contact are large.
  /// Obstacles or pins that move the cloth add the work of errors in their forces.
  /// @param work of the contacts [J] @param tolerance δ of the solve, 0 if it is not met [m]
  /// @param driven true if obstacles or pins move the cloth
  [[nodiscard]] bool gains_in_contact(const Iterate& point, double work, double tolerance, bool driven);
  /// Returns true if ΔK + ΔE − W at the point exceeds rounding.
  /// @param tolerant true to subtract the tolerated gain
  [[nodiscard]] bool gains(const Iterate& point, bool tolerant);
  /// Returns true if a change from one end of the step to another makes ΔK + ΔE − W positive, or more so, by more than
  /// is tolerated [J].
  [[nodiscard]] bool adds(const Iterate& from, const Iterate& to, double tolerated);
  /// Measures all energies and works of this step in a frame that moves by `way` in it [m], as seen from which what is
  /// carried along has little energy.
  void follow(const Eigen::RowVector3d& way) { frame_ = way; }
  /// Returns true if ΔK + ΔE − W exceeds the work of moving obstacles [J], where that is positive, by a hundredth of it
  /// and of the kinetic energy at the start.
  [[nodiscard]] bool gains_much(const Iterate& point, double work) const;
  /// Moves a point that gains energy towards the start of the step until it gains no more than is allowed. Returns the
  /// remaining fraction of the path. A free cloth moves towards its rigid translation instead, and in a moving frame
  /// towards the start carried along.
  /// @param touches true if contacts hold the cloth
  /// @param allowed [J]
  double remove_gain(Iterate& point, bool touches = false, double allowed = 0);
  /// Stores the energy at the end of the step.
  void end(const Iterate& point);

 private:
  /// Computes g at the start exactly.
  void evaluate_start();
  /// Returns ΔK + ΔE − W of a point [J], or an upper bound while start_ is not exact.
  [[nodiscard]] double gain(const Iterate& point) const;
  /// Returns the expected rounding error of the gain [J].
  [[nodiscard]] double rounding(const Iterate& point) const;
  /// Returns ½‖v' − v‖²_M [J].
  [[nodiscard]] double lost(const Iterate& point) const;
  /// Returns the gain that a step within its tolerance may have, see above [J].
  [[nodiscard]] double tolerated(const Iterate& point) const;

  const System& system_;
  const StepObjective& objective_;
  const Minimiser& minimiser_;
  const State* state_ = nullptr;  // at the start of the step
  Iterate start_;                 // x with the pins' final positions, with the value and gradient of g
  bool start_exact_ = false;      // false while start_ holds only a lower bound of g
  double start_kinetic_ = 0;      // ½‖v‖²_M [J]
  Eigen::RowVector3d frame_ = Eigen::RowVector3d::Zero();  // see follow()
  double end_energy_ = 0;                                  // lower bound of E at the end of the last step [J]
  bool steady_;   // E at the start of a step equals E at the end of the last one
  bool springs_;  // E consists only of springs
};

/// Returns the mass-weighted mean of n×3 numbers.
Eigen::RowVector3d mean(const Cloth& cloth, const Vertices& v);

/// Returns true if the cloth has no pins and no velocity fields.
bool is_free(const System& system);

/// Translates a free cloth to where Σ∇g = 0. There Σ∇g = Σ m(x' − y)/h², as internal forces cancel. An exact solve
/// makes this sum zero. The translation removes the rounding of a factor and so conserves momentum to rounding.
void balance_momentum(const Cloth& cloth, const StepObjective& objective, Iterate& point);

}  // namespace drape
