#pragma once

#include "sim/spring_network.hpp"
#include "sim/system.hpp"

namespace drape {

/// What an implicit step of τ seconds from x₀ with v₀ minimises over the free vertices (Liu et al. 2013, eq. 5, divided
/// by τ²):
///   g(x) = 1/(2τ²) ‖x − y‖²_M + E(x),   y = x₀ + τ v₀ + τ² M⁻¹ f,
/// with E the energy of the springs and of everything else in the system that has one. A scheme may be made of several
/// such steps, all of the same length.
/// Pinned vertices are no unknowns: y has them where they are when it ends, and every gradient is zero there, so
/// that plain vector arithmetic never moves them.
class StepObjective {
 public:
  /// @param duration τ [s]
  StepObjective(const System& system, double duration);

  /// Begins another step: computes y.
  /// @param x, v  where it starts, n×3 [m], [m/s]; longest_way() and place_of_start_forces() read them again
  /// @param force f, n×3 [N]
  /// @param end   the time when it ends [s]
  void begin(const Vertices& x, const Vertices& v, const Vertices& force, double end);

  /// Where the cloth would go without its energies, and where the pins are when the step ends, n×3 [m].
  [[nodiscard]] const Vertices& y() const { return y_; }

  /// How far a step that ends at x moves a free vertex at most [m].
  struct Way {
    double whole = 0;      ///< ‖x − x₀‖
    double by_forces = 0;  ///< ‖x − x₀ − τ v₀‖, which is τ²a with the acceleration a of the step
  };
  [[nodiscard]] Way longest_way(const Vertices& x) const;

  /// Sets x to where the cloth would go if all forces, those of its energies too, stayed what they are at the start,
  /// n×3 [m]: y − τ² M⁻¹ ∇E(x₀). Computes ∇g(x₀) on the way.
  void place_of_start_forces(Vertices& x, Vertices& gradient) const;

  /// Computes gradient = ∇g(x), n×3 and zero on pins [N], and returns g(x) [J], in one pass.
  double evaluate(const Vertices& x, Vertices& gradient) const;

  /// The part of g(x) that is inertia's, 1/(2τ²) ‖x − y‖²_M [J].
  [[nodiscard]] double inertial_value(const Vertices& x) const;

  /// The error that rounding can be expected to make where g has this value [J]. A length L is known to ε·L, which
  /// changes the energy of a spring by k·|‖d‖ − L|·ε·L; the sum of these is at most ε √(2g) √(Σ k L²), and so for
  /// inertia. Bending's energy is a sum over pairs of either sign, ½ Σ k d², of which little is left where the cloth is
  /// flat: it is known to ε ½ Σ |k| d².
  [[nodiscard]] double rounding(double value) const;

  /// The least energy [J] that the springs have where no vertex is further than `distance` [m] from where they had this
  /// energy [J] or more. With s the stretches, √(2E) = √(Σ k s²) is a norm, and none changes by more than two
  /// distances: √(2E') ≥ √(2E) − 2 distance √(Σ k).
  [[nodiscard]] double least_elastic(double energy, double distance) const;

  /// How far the worst vertex is from the minimum at most, where g is convex and has this gradient [m]: no Hessian is
  /// below the inertia, so ‖x − x*‖_M ≤ ‖M⁻¹∇g‖_M h². Taken for each vertex by itself, h²‖∇gᵢ‖/mᵢ, it is an estimate:
  /// how good, docs/accuracy.md says.
  [[nodiscard]] double error_bound(const Vertices& gradient) const;

  /// What rounding makes of error_bound() at the minimum [m]: positions are known to ε‖x‖, the springs' forces to as
  /// much times their stiffness.
  [[nodiscard]] double error_rounding() const;

  [[nodiscard]] const SpringNetwork& springs() const { return springs_; }
  /// That share its passes.
  [[nodiscard]] const Threads& threads() const { return system_.threads; }
  /// τ [s].
  [[nodiscard]] double duration() const { return duration_; }
  /// m/τ² of every vertex [N/m].
  [[nodiscard]] const Eigen::VectorXd& inertia() const { return inertia_; }
  /// The same, but 0 at pins.
  [[nodiscard]] const Eigen::VectorXd& free_inertia() const { return free_inertia_; }
  /// The time at the end of the step [s].
  [[nodiscard]] double time() const { return time_; }

 private:
  const System& system_;
  double duration_;
  SpringNetwork springs_;
  Eigen::VectorXd inertia_, free_inertia_;
  Eigen::VectorXd push_;  // τ²/m, 0 on pins [m/N]
  Eigen::ArrayXd free_;   // 1, and 0 on pins
  const Vertices *start_x_ = nullptr, *start_v_ = nullptr;
  Vertices y_;
  double time_ = 0;
  double stiffness_ = 0;                  // Σ k [N/m]
  double elastic_scale_ = 0, scale_ = 0;  // Σ k L², and that with Σ m/τ² ‖y‖² [J]
  double cancelling_ = 0;                 // ½ Σ |k| d² of pairs that are no springs [J]
  double stiffness_ratio_ = 1;            // the most that inertia and springs hold a vertex with, of inertia alone
};

}  // namespace drape
