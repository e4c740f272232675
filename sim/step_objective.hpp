#pragma once

#include "sim/spring_network.hpp"
#include "sim/system.hpp"

namespace drape {

/// What a step of implicit Euler minimises over the free vertices (Liu et al. 2013, eq. 5, divided by h²):
///   g(x) = 1/(2h²) ‖x − y‖²_M + E(x),   y = xₙ + h vₙ + h² M⁻¹ f,
/// with E the energy of the springs and of everything else in the system that has one.
/// Pinned vertices are no unknowns: y has them where they are when the step ends, and every gradient is zero there, so
/// that plain vector arithmetic never moves them.
class StepObjective {
 public:
  explicit StepObjective(const System& system);

  /// Begins a step: computes y.
  /// @param force evaluated at the start of the step, n×3 [N]
  void begin(const State& state, const Vertices& force);

  /// Where the cloth would go without its energies, and where the pins are when the step ends, n×3 [m].
  [[nodiscard]] const Vertices& y() const { return y_; }

  /// Computes gradient = ∇g(x), n×3 and zero on pins [N], and returns g(x) [J], in one pass.
  double evaluate(const Vertices& x, Vertices& gradient) const;

  /// The part of g(x) that is inertia's, 1/(2h²) ‖x − y‖²_M [J].
  [[nodiscard]] double inertial_value(const Vertices& x) const;

  /// The error that rounding can be expected to make where g has this value [J]. A length L is known to ε·L, which
  /// changes the energy of a spring by k·|‖d‖ − L|·ε·L; the sum of these is at most ε √(2g) √(Σ k L²), and so for
  /// inertia.
  [[nodiscard]] double rounding(double value) const;

  /// How far the worst vertex is from the minimum at most, where g is convex and has this gradient [m]: no Hessian is
  /// below the inertia, so ‖x − x*‖_M ≤ ‖M⁻¹∇g‖_M h². Taken for each vertex by itself, h²‖∇gᵢ‖/mᵢ, it is an estimate:
  /// how good, docs/accuracy.md says.
  [[nodiscard]] double error_bound(const Vertices& gradient) const;

  /// What rounding makes of error_bound() at the minimum [m]: positions are known to ε‖x‖, the springs' forces to as
  /// much times their stiffness.
  [[nodiscard]] double error_rounding() const;

  [[nodiscard]] const SpringNetwork& springs() const { return springs_; }
  /// m/h² of every vertex [N/m].
  [[nodiscard]] const Eigen::VectorXd& inertia() const { return inertia_; }
  /// The same, but 0 at pins.
  [[nodiscard]] const Eigen::VectorXd& free_inertia() const { return free_inertia_; }
  /// The time at the end of the step [s].
  [[nodiscard]] double time() const { return time_; }

 private:
  const System& system_;
  SpringNetwork springs_;
  Eigen::VectorXd inertia_, free_inertia_;
  Eigen::VectorXd push_;  // h²/m, 0 on pins [m/N]
  Vertices y_;
  double time_ = 0;
  double elastic_scale_ = 0, scale_ = 0;  // Σ k L², and that with Σ m/h² ‖y‖² [J]
  double stiffness_ratio_ = 1;            // the most that inertia and springs hold a vertex with, of inertia alone
};

}  // namespace drape
