#pragma once

#include "sim/solvers/minimiser.hpp"
#include "sim/step_objective.hpp"

namespace drape {

/// Keeps the books of the energy in a step of backward Euler. Where an iteration stops ∇g is not quite zero, and with
/// Δx = x' − x and v' = Δx/h the energy changes by
///   ΔK + ΔE = W − ½‖v' − v‖²_M − B + ∇g·Δx,   B = E(x) − E(x') − ∇E(x')·(x − x'),
/// W the work of the forces (∇g written out, times Δx). That is positive where a step stops early (∇g·Δx) and may be
/// where springs end compressed, so that E is concave (B < 0). Such a step is not over, however small the changes have
/// become; and at the cap it goes back towards x until nothing is gained. So a method that is far from its minimum, as
/// liu13 is with very stiff springs, or has found one of a crumpled cloth, loses energy and gains none.
///
/// One gain is tolerated where the tolerance is met, since the homework's tolerances stop there: a tenth of the most
/// that the forces can do in a step, ‖h M⁻¹f‖_M ‖v'‖_M, provided that the step loses as much otherwise, ½‖v' − v‖²_M,
/// or that the forces take as much, −W. In proportion to speed it is what a tenth of the forces' size would give if it
/// pushed along the way; it has no share in what the cloth has, so it cannot compound. Who stops at a gradient
/// is given what that can do, tolerance·‖Δx‖, and who stops at an error δ what the forces that it leaves can do,
/// Σ m/h² δ ‖Δxᵢ‖.
class EnergyBooks {
 public:
  EnergyBooks(const System& system, const StepObjective& objective, const Minimiser& minimiser);

  /// Notes what the cloth has at the start of a step, whose y the objective has.
  /// @param state must stay as it is until the step ends
  /// @param last_end where end() was told that the last step ended
  void begin(const State& state, const Vertices& last_end);
  /// Whether ΔK + ΔE − W at the point, where contacts have done this work on the cloth [J], is more than rounding
  /// explains.
  [[nodiscard]] bool gains_in_contact(const Iterate& point, double work);
  /// Whether ΔK + ΔE − W at the point is more than rounding explains.
  /// @param tolerant and more than is tolerated
  [[nodiscard]] bool gains(const Iterate& point, bool tolerant);
  /// Goes back from a point that gains towards where the step started until it gains nothing; returns the part of the
  /// way that is left. A cloth that nothing holds goes back to where it would be as a whole.
  /// @param touches whether contacts hold the cloth
  double shed(Iterate& point, bool touches = false);
  /// Notes what the cloth has where the step ends.
  void end(const Iterate& point);

 private:
  /// Computes g at the start exactly.
  void evaluate_start();
  /// ΔK + ΔE − W of a point [J], or an upper bound of it as long as start_ is not exact.
  [[nodiscard]] double gain(const Iterate& point) const;
  /// The error that rounding can be expected to make in it [J].
  [[nodiscard]] double rounding(const Iterate& point) const;
  /// ½‖v' − v‖²_M [J].
  [[nodiscard]] double lost(const Iterate& point) const;
  /// What a step that meets its tolerance may gain, see above [J].
  [[nodiscard]] double tolerated(const Iterate& point) const;

  const System& system_;
  const StepObjective& objective_;
  const Minimiser& minimiser_;
  const State* state_ = nullptr;  // at the start of the step
  Iterate start_;                 // its x with its pins where they are when the step ends, and g there…
  bool start_exact_ = false;      // …or, where it has not been needed, a lower bound of g and nothing else
  double start_kinetic_ = 0;      // ½‖v‖²_M [J]
  double end_energy_ = 0;         // a lower bound of E where the last step ended [J]
  bool steady_;                   // E is at the start of a step what it was there when the last one ended…
  bool springs_;                  // …and nothing but that of springs
};

/// The mean of n×3 numbers, weighted by mass.
Eigen::RowVector3d mean(const Cloth& cloth, const Vertices& v);

/// Whether nothing holds the cloth and nothing that it is solved with pushes it.
bool is_free(const System& system);

/// Moves a cloth that nothing holds as a whole to where Σ∇g = 0. There Σ∇g = Σ m(x' − y)/h², since what it solves for
/// pulls with opposite forces. Every exact solve makes that zero; what the rounding of a factor leaves of it is taken
/// out by a translation, which keeps the momentum to rounding.
void balance_momentum(const Cloth& cloth, const StepObjective& objective, Iterate& point);

}  // namespace drape
