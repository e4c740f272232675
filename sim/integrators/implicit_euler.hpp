#pragma once

#include "sim/integrators/integrator.hpp"
#include "sim/step_objective.hpp"

namespace drape {

/// Implicit Euler as a minimisation: x' = argmin g, v' = (x' − x)/h, then the corrections. The methods differ in the
/// direction that an iteration goes.
///
/// Where an iteration stops ∇g is not quite zero, and with Δx = x' − x and v' = Δx/h the energy of a step changes by
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
/// is given what that can do, tolerance·‖Δx‖.
///
/// A cloth that nothing holds has Σ∇g = Σ m(x' − y)/h², since what it solves for pulls with opposite forces. Every
/// exact solve makes that zero; what the rounding of a factor leaves of it is taken out by a translation, which keeps
/// the momentum to rounding.
class ImplicitEuler : public Integrator {
 public:
  StepReport advance(State& state, const Vertices& force) final;
  [[nodiscard]] double residual() final;

 protected:
  /// Where the minimisation is, with what g is there.
  struct Point {
    Vertices x;         ///< n×3 [m]
    Vertices gradient;  ///< ∇g(x), n×3, zero on pins [N]
    double value = 0;   ///< g(x) [J]
  };

  ImplicitEuler(const System& system, const IntegratorSettings& settings, int default_max_iterations);

  /// Begins the minimisation of another step.
  virtual void start() {}
  /// One iteration: moves the point, and returns how far [m], the 2-norm over all unknowns.
  virtual double iterate(Point& point) = 0;

  /// Tries x = point.x − length·direction with lengths 1, 1/2, 1/4 … until g decreases enough (Armijo's condition), and
  /// moves the point there, so that g never rises beyond rounding.
  /// @param slope ∇g·direction, positive [J]
  /// @return the length, or 0 where none was found: the point is as low as it can be computed
  double descend(Point& point, const Vertices& direction, double slope);

  [[nodiscard]] const StepObjective& objective() const { return objective_; }

 private:
  StepReport minimise(const State& state);
  /// Notes what the cloth has at the start of a step.
  void begin_books(const State& state);
  /// Whether ΔK + ΔE − W at the point is more than rounding explains.
  /// @param tolerant and more than is tolerated
  [[nodiscard]] bool gains_energy(const State& state, bool tolerant);
  /// ΔK + ΔE − W of a point [J], or an upper bound of it as long as start_ is not exact.
  [[nodiscard]] double gain(const State& state, const Point& point) const;
  /// The error that rounding can be expected to make in it [J].
  [[nodiscard]] double gain_rounding() const;
  /// What a step that meets its tolerance may gain, see above [J].
  [[nodiscard]] double tolerated_gain(const State& state) const;
  /// Goes back towards where the step started until it has gained no energy; returns the part of the way that is left.
  double shed_energy(const State& state);
  /// Moves the cloth as a whole to where Σ∇g = 0.
  void balance_momentum();
  /// The mean of n×3 numbers, weighted by mass.
  [[nodiscard]] Eigen::RowVector3d mean(const Vertices& v) const;

  const System& system_;
  StoppingRule stop_;
  double tolerance_;
  int max_iterations_;
  StepObjective objective_;
  Point point_, trial_;
  Point start_;               // state.x with its pins where they are when the step ends, and g there…
  bool start_exact_ = false;  // …or, where it has not been needed, a lower bound of it
  double start_kinetic_ = 0;  // ½‖v‖²_M [J]
  double energy_ = 0;         // E where the last step ended [J]
  bool free_;                 // nothing holds the cloth and nothing it solves for pushes it
};

}  // namespace drape
