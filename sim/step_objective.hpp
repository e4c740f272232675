#pragma once

#include "sim/spring_network.hpp"
#include "sim/system.hpp"

namespace drape {

/// Objective function of an implicit step of τ seconds from x₀ with v₀, over the free vertices (Liu et al. 2013, eq. 5,
/// divided by τ²):
///   g(x) = 1/(2τ²) ‖x − y‖²_M + E(x),   y = x₀ + τ v₀ + τ² M⁻¹ f,
/// where E is the energy of the springs and all other energies of the system. A scheme may use several such steps of
/// the same length.
/// Pinned vertices are not unknowns: y contains their final positions, and every gradient is zero there. So plain
/// vector arithmetic never moves them.
class StepObjective {
 public:
  /// @param duration τ [s]
  StepObjective(const System& system, double duration);

  /// Begins another step: computes y.
  /// @param x, v  initial positions and velocities, n×3 [m], [m/s]; must stay valid until the step ends
  /// @param force f, n×3 [N]
  /// @param end   time at the end of the step [s]
  void begin(const Vertices& x, const Vertices& v, const Vertices& force, double end);

  /// Returns the final positions without energies, and of the pins, n×3 [m].
  [[nodiscard]] const Vertices& y() const { return y_; }

  /// Largest displacement of a free vertex in a step that ends at x [m].
  struct Displacement {
    double total = 0;      ///< ‖x − x₀‖
    double by_forces = 0;  ///< ‖x − x₀ − τ v₀‖, which is τ²a with the acceleration a of the step
  };
  [[nodiscard]] Displacement largest_displacement(const Vertices& x) const;

  /// Sets x to the final positions under constant initial forces, including those of energies: y − τ² M⁻¹ ∇E(x₀), n×3
  /// [m]. Also computes ∇g(x₀).
  void predict_with_start_forces(Vertices& x, Vertices& gradient) const;

  /// Computes gradient = ∇g(x), n×3 and zero on pins [N], and returns g(x) [J], in one pass.
  double evaluate(const Vertices& x, Vertices& gradient) const;

  /// Returns the inertial part of g(x), 1/(2τ²) ‖x − y‖²_M [J].
  [[nodiscard]] double inertial_value(const Vertices& x) const;

  /// Returns the expected rounding error of g at this value [J]. A length L has the error ε·L, which changes the energy
  /// of a spring by k·|‖d‖ − L|·ε·L. The sum over springs is at most ε √(2g) √(Σ k L²); the same holds for inertia.
  /// Bending energy sums pairs of either sign, ½ Σ k d², which cancel in flat cloth; its error is ε ½ Σ |k| d².
  [[nodiscard]] double rounding(double value) const;

  /// Returns a lower bound on the springs' energy [J] after a displacement of at most `distance` [m] from positions of
  /// at least `energy` [J]. With stretches s, √(2E) = √(Σ k s²) is a norm. No stretch changes by more than two
  /// distances, so √(2E') ≥ √(2E) − 2 distance √(Σ k).
  [[nodiscard]] double least_elastic(double energy, double distance) const;

  /// Returns an estimate of the worst vertex's distance from the minimum at this gradient [m]. For convex g, every
  /// Hessian is at least the inertia, so ‖x − x*‖_M ≤ ‖M⁻¹∇g‖_M h². Per vertex, h²‖∇gᵢ‖/mᵢ is an estimate;
  /// docs/notes/accuracy.md shows how good.
  [[nodiscard]] double error_bound(const Vertices& gradient) const;

  /// Returns the rounding error of error_bound() at the minimum [m]. Positions have the error ε‖x‖, and the springs'
  /// forces that times their stiffness.
  [[nodiscard]] double error_rounding() const;

  [[nodiscard]] const SpringNetwork& springs() const { return springs_; }
  /// Returns the threads of its passes.
  [[nodiscard]] const Threads& threads() const { return system_.threads; }
  /// Returns τ [s].
  [[nodiscard]] double duration() const { return duration_; }
  /// Returns m/τ² of every vertex [N/m].
  [[nodiscard]] const Eigen::VectorXd& inertia() const { return inertia_; }
  /// Returns m/τ² of every vertex, but 0 at pins [N/m].
  [[nodiscard]] const Eigen::VectorXd& free_inertia() const { return free_inertia_; }
  /// Returns the time at the end of the step [s].
  [[nodiscard]] double time() const { return time_; }

 private:
  const System& system_;
  double duration_;
  const SpringNetwork& springs_;
  Eigen::VectorXd inertia_, free_inertia_;
  Eigen::VectorXd push_;  // τ²/m, 0 on pins [m/N]
  Eigen::ArrayXd free_;   // 1, and 0 on pins
  const Vertices *start_x_ = nullptr, *start_v_ = nullptr;
  Vertices y_;
  double time_ = 0;
  double stiffness_ = 0;                  // Σ k [N/m]
  double elastic_scale_ = 0, scale_ = 0;  // Σ k L², and that with Σ m/τ² ‖y‖² [J]
  double cancelling_ = 0;                 // ½ Σ |k| d² of pairs that are no springs [J]
  double stiffness_ratio_ = 1;            // largest ratio of inertia plus springs to inertia alone
};

/// Forces on a cloth in a step, evaluated at the states and times that a scheme requests. Constant forces are summed
/// once.
class StepForces {
 public:
  /// @param system may be replaced in place by one for a cloth with other pins
  StepForces(const System& system, const State& start);

  /// Returns the sum of all forces at a state and a time [s], n×3 [N]. Valid until the next call.
  const Vertices& all(const State& state, double time);

  /// Returns the sum of forces that do not depend on velocities.
  const Vertices& sum_position_forces(const State& state, double time);

  /// Returns true if any force depends on velocities.
  [[nodiscard]] bool any_depends_on_velocity() const;
  /// Sets force = the sum of forces that depend on velocities.
  void sum_velocity_forces(const State& state, double time, Vertices& force) const;
  /// Records the mean of velocity-dependent forces in the step [N].
  void record_velocity_force(const Vertices& mean);

  /// Returns the mean force in the last step, as far as evaluated and recorded, for the energy balance [N].
  [[nodiscard]] const Vertices& push() const { return *push_; }
  /// Returns true if the mean force is the same in every step.
  [[nodiscard]] bool constant() const { return push_ == &constant_; }

 private:
  template <class Wanted>
  const Vertices& sum(const State& state, double time, const Wanted& wanted);

  const System& system_;
  Vertices constant_, force_;
  const Vertices* push_;
};

}  // namespace drape
