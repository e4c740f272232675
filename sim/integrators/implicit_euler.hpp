#pragma once

#include "sim/integrators/integrator.hpp"
#include "sim/step_objective.hpp"

namespace drape {

/// Implicit Euler as a minimisation: x' = argmin g, v' = (x' − x)/h, then the corrections. The methods differ in the
/// direction that an iteration goes.
///
/// Where an iteration stops ∇g is not quite zero, and with Δx = x' − x and v' = Δx/h the energy of a step changes by
///   ΔK + ΔE = W − ½‖v' − v‖²_M − B + ∇g·Δx,   B = E(x) − E(x') − ∇E(x')·(x − x'),
/// W the work of the forces (∇g written out, times Δx). Only the last term comes from stopping early. While it makes
/// the energy grow by more than three hundredths, small changes do not end a step; and at the cap it goes back towards
/// x until nothing is gained. So a method that is far from its minimum, as liu13 is with very stiff springs, loses
/// energy and gains none. A step that stops at a gradient keeps that promise and no other.
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
  /// Whether the energy has grown by more than the work and by more than a share of what it is now, because of what is
  /// left of ∇g.
  [[nodiscard]] bool gains_energy(const State& state, double share);
  /// ΔK + ΔE − W of a point [J].
  [[nodiscard]] double gain(const State& state, const Point& point);
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
  Point start_;               // state.x with its pins where they are when the step ends
  bool start_known_ = false;  // whether start_ is of this step
  bool free_;                 // nothing holds the cloth and nothing it solves for pushes it
};

}  // namespace drape
