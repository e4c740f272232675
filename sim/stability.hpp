#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "drape/core/error.hpp"
#include "sim/system.hpp"

namespace drape {

/// Returns the largest step h [s] for which semi-implicit Euler is stable in any motion: 2/√λ_max(M⁻¹L). This covers
/// the free vertices and the pins that are released at some time. L = Σ k (eᵢ − eⱼ)(eᵢ − eⱼ)ᵀ is the sum over springs
/// and pairs coupled by energies. It bounds every Hessian, so √λ_max bounds every frequency of the cloth. Upper bounds
/// for forces that depend on the position (an explicit push) are added to λ_max. The step is infinite if nothing acts
/// on free vertices.
///
/// λ_max is found by Lanczos iteration to a relative 1e-4 from below, plus the error bound of that value. The last
/// value is cached, as a scene is checked before it is simulated.
double safe_step(const System& system);

/// Ratio of safe_step() to a step whose energy varies little. At the limit K + E of an oscillation varies much, and
/// impacts turn some of that into a gain.
inline constexpr double calm_ratio = 1.2;

/// Returns √λ_max(M⁻¹L) of the springs and pairs alone, as in safe_step() [1/s].
double highest_frequency(const System& system);

/// Returns the largest stable step of a vertex without springs under position-dependent forces [s], for schemes that
/// evaluate them once per step. Infinite if there are none or their slope is unknown.
double safe_step_of_pushes(const System& system);

/// Returns a bound on the ratio of stiffness and inertia to inertia, 1 + h² max (2 Σ k + c)/m over the free vertices. k
/// are the stiffnesses of springs and couplings there, and c bounds the energies of single vertices. The smallest
/// possible eigenvalue of the implicit step's matrix M/h² + L is m/h². By Gershgorin's theorem no eigenvalue exceeds it
/// by more than this ratio. So it bounds the condition number of that matrix and of every smaller Hessian. For flat
/// cloth, where only inertia resists motion across its plane, the bound is reached within a factor of about two.
double condition_bound(const System& system);

/// Value of condition_bound() beyond which double precision loses the inertia beside the springs.
inline constexpr double largest_condition = 1e14;

/// Returns the rounding error of the elastic energy due to the positions [J]. With every spring at its rest length, a
/// relative error ε of lengths leaves Σ k (εL)²/2.
double energy_rounding(const System& system);

/// Detector of motions with more energy than the explained energy, which is the initial one plus the work of the
/// forces, Σ|f·Δx|.
class BlowUpWatch {
 public:
  static constexpr double limit_of_unstable_steps = 1e4;
  /// Returns the ratio to the explained energy that counts as a blow-up of an explicit method. Symplectic Euler
  /// conserves K + E − (h/2)·v·∇E of a linear cloth. With r = step/safe_step() < 1 this is between (1 − r) and (1 + r)
  /// times K + E, so K + E varies by at most a factor of (1 + r)/(1 − r). The limit is four times that. Velocity Verlet
  /// conserves (1 − r²) K + E and varies less. Beyond r = 1 the energy grows by a constant factor per step; ten
  /// thousand times the explained energy is far beyond any stable motion and reached after a few steps.
  /// @param ratio step/safe_step()
  static double limit(double ratio);

  /// @param limit    ratio to the explained energy that counts as a blow-up
  /// @param interval steps between two checks
  BlowUpWatch(const System& system, double limit, int interval);

  /// Begins with a state of the energy K + E [J].
  void begin(const State& state, double energy);

  /// Returns the checkpoint state.
  [[nodiscard]] const EnergyMemory& memory() const { return memory_; }
  /// Restores a checkpoint state.
  void restore(const EnergyMemory& memory) { memory_ = memory; }

  /// Adds the work of a step that has ended, and checks the energy after every interval, see
  /// StabilityGuard::check_step.
  std::optional<double> check_step(const State& state, const Vertices& push, bool constant,
                                   const std::function<double(double enough)>& energy);

 private:
  double step_;  // [s]
  double limit_;
  int interval_;
  double rounding_;  // see energy_rounding() [J]
  EnergyMemory memory_;
};

/// Returns an error that names the step, the time, the worst vertex (the first non-finite, or else the fastest), the
/// growth of the energy, and the remedy.
/// @param growth of the energy, see BlowUpWatch; absent: numbers are no longer finite
/// @param remedy see StabilityGuard
DivergedError diverged(const State& state, double time, std::optional<double> growth, const std::string& remedy);

}  // namespace drape
