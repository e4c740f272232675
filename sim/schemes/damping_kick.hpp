#pragma once

#include <cstdint>

#include "sim/dashpots.hpp"

namespace drape {

/// Effect of dashpots in an explicit step: v ← D v, where D approximates exp(−t M⁻¹C) for a duration t.
///
/// D is the polynomial a + b T_s(w₀ − w₁ t M⁻¹C) of the second-order Runge-Kutta-Chebyshev method (Sommeijer, Shampine
/// and Verwer 1998, "RKC: an explicit solver for parabolic PDEs", eqs. 2.6 to 2.8), with the fewest stages s that are
/// stable: z = t λ_max(M⁻¹C) needs s ≈ √(1.5 z + 1) products with C, where plain explicit dashpots need z/2 steps.
/// Nothing is solved, so the forces keep both momenta to rounding. Between 0 and z the polynomial lies between 0 and 1:
/// D is symmetric in the masses' inner product, and never raises the kinetic energy.
///
/// The safe step is that without dashpots, however rarely they act. Without them a linear cloth conserves
///   Q = ½ wᵀM w + ½ xᵀ(K − h²/4 K M⁻¹K) x,
/// with the velocities w in the middle of the kick at x. Q is positive definite up to the safe step, and D, applied to
/// w, lowers it. If forces depend on velocities, half of the dashpots act before the kick and half after it, in every
/// step. With x' = x + h u' and u' = √D (√D u − h M⁻¹K x) an eigenvector satisfies λ² a − λ (a + d − h²κ) + d = 0 with
/// a = x·D⁻¹x, d = x·D x, κ = x·Kx in that inner product. As a + d ≥ 2 x·x and d ≤ a, no |λ| exceeds 1 if h²κ ≤ 4 x·x.
///
/// A step that is divided into substeps has a kick of the dashpots for up to 24 of them, since stages grow with the
/// square root of the duration only. Kicks lie symmetrically in the step, so the order remains 2.
class DampingKick {
 public:
  /// @param duration t [s]
  /// @throws UsageError if too many stages are needed
  DampingKick(const System& system, double duration);

  /// Sets the directions of the dashpots to those at positions x, n×3 [m].
  void set_directions(const Vertices& x);
  /// Applies D to the velocities, n×3 [m/s]. Pins keep theirs.
  void apply(Vertices& v);
  /// Applies D in the middle of a kick that changes the velocities from `before` to v.
  void apply_within(const Vertices& before, Vertices& v);

  /// Returns the number of kicks of the dashpots in a step of so many substeps.
  static std::int64_t kicks_in(std::int64_t substeps);
  /// Returns true if the dashpots act in a substep, counted as State::step.
  static bool acts_in(std::int64_t step, std::int64_t substeps);

  /// Returns the number s of stages for z; for more than a thousand, a thousand and one.
  static int stages_for(double z);

 private:
  /// Sets to = factor·(w₀ − w₁ h M⁻¹C) from − to.
  void advance(double factor, const Vertices& from, Vertices& to);

  const System& system_;
  int stages_;
  double w0_, a_, b_;
  Eigen::VectorXd rate_;              // w₁ h/m of each vertex, 0 on pins [s/kg]
  Vertices half_kick_;                // [m/s]
  Vertices before_, last_, product_;  // T_{j−1} v, T_j v [m/s]; [N]
};

}  // namespace drape
