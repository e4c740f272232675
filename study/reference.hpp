#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "drape/sim/simulation.hpp"
#include "drape/sim/state.hpp"
#include "run/progress.hpp"

namespace drape {

/// The distance of two shapes of a cloth, over its vertices [m].
struct Distance {
  double max = 0, rms = 0;
};
Distance distance(const Vertices& a, const Vertices& b);

/// Returns the settings with an implicit method that iterates until the change is at the level of rounding. Forces at a
/// vertex are known to ε·|x|·Σk, which moves it by at most h²/m times that.
SimulationSettings to_rounding(SimulationSettings settings, Method method);

/// A motion computed by Newton's method to rounding, and by quasi-Newton for comparison.
struct ReferenceMotion {
  std::vector<State> states;  ///< by Newton, at the requested steps
  std::vector<double> apart;  ///< largest distance of a vertex in the two motions, [k] after step k+1 [m]

  /// Returns their distance after a step; 0 before the first.
  [[nodiscard]] double apart_after(std::int64_t step) const {
    return step == 0 ? 0 : apart[static_cast<std::size_t>(step - 1)];
  }
  /// Returns the first step after which their distance exceeds the limit [m].
  [[nodiscard]] std::optional<std::int64_t> first_beyond(double limit) const;
};

/// Computes a reference motion. Stores the states of the steps in `keep`, ascending and at most `steps`.
/// @returns nothing if stopped
/// @throws DivergedError
std::optional<ReferenceMotion> run_reference(const SimulationSettings& settings, std::int64_t steps,
                                             const std::vector<std::int64_t>& keep, const std::stop_token& stop,
                                             Progress& progress);

/// Returns the first step at which contact changes the motion by more than a limit [m]. It compares with the motion
/// without spheres, grounds, self-collision and strain limit. Nothing if there is no contact within `steps`.
/// @throws DivergedError
std::optional<std::int64_t> first_contact(const SimulationSettings& settings, std::int64_t steps, double limit,
                                          const std::stop_token& stop);

/// True local error of a single step, of time stepping and solve together. Compares the end of the step with that of
/// very small steps from the same state. Verlet's steps are the cheapest and are used if stable and able to compute all
/// effects; otherwise quasi-Newton's with SDIRK2, solved to rounding. Extrapolation removes their second-order error.
class LocalErrors {
 public:
  /// @throws UsageError if small steps are impossible
  explicit LocalErrors(const SimulationSettings& settings);

  struct LocalError {
    double error = 0;    ///< largest distance of a vertex [m]
    double unknown = 0;  ///< distance of the small steps from their extrapolation [m]
  };

  /// Computes the error of the step from `before` to `after`; nothing if the small steps diverge.
  std::optional<LocalError> of_step(const State& before, const Vertices& after);

 private:
  /// @param step of the scene, which the small steps divide [s]
  void make(SimulationSettings small, double step);
  /// Returns the positions after 2^halvings small steps.
  Vertices small_steps(Simulation& simulation, int halvings, State from);

  int halvings_ = 0;
  std::optional<Simulation> small_, twice_;
};

/// The error of a step's solve relative to the exact minimiser of g, as means over several start states.
struct SolveError {
  double max = 0;       ///< largest distance of a vertex [m]
  double rms = 0;       ///< root mean square of the distances [m]
  double gradient = 0;  ///< final ‖∇g‖ relative to ‖∇g(y)‖ at the start of the minimisation
};

/// Steps from given states, solved to rounding by Newton's method and by quasi-Newton. A state whose two results differ
/// by more than `limit` is dropped: there the minimum is too flat to measure errors.
class ExactSteps {
 public:
  /// @throws DivergedError
  ExactSteps(const SimulationSettings& settings, const std::vector<State>& states, double limit);

  /// Returns the number of remaining states; left_out() returns that of dropped ones.
  [[nodiscard]] std::size_t count() const { return states_.size(); }
  [[nodiscard]] std::size_t left_out() const { return left_out_; }
  /// Returns the largest distance of the two results, over the remaining states [m].
  [[nodiscard]] double apart() const { return apart_; }

  /// Returns the error of an implicit method with its tolerance.
  [[nodiscard]] SolveError error(const IntegratorSettings& integrator) const;

 private:
  SimulationSettings settings_;
  std::vector<State> states_;
  std::vector<Vertices> minimisers_;
  std::vector<double> first_gradients_;  // ‖∇g(y)‖ [N]
  std::size_t left_out_ = 0;
  double apart_ = 0;
};

/// Positions of the cloth at some moments in the limit of vanishing steps.
struct StepReference {
  std::vector<std::int64_t> moments;  ///< step numbers of the scene, ascending
  /// (4·x(h) − x(2h))/3: Richardson extrapolation, which removes the second-order error [m].
  std::vector<Vertices> x;
  std::vector<Vertices> plain;  ///< x(h) [m]
  double step = 0;              ///< step length h [s]
  double apart = 0;             ///< distance of x from the extrapolation of doubled steps, at the first moment [m]

  /// Returns the index of a moment in the lists; nothing if it is none.
  [[nodiscard]] std::optional<std::size_t> place(std::int64_t moment) const;
  /// Returns the distance between x(h) and x [m]. In a smooth motion it is far larger than the error of x.
  [[nodiscard]] double gained(std::size_t place) const;
};

/// Computes the reference with Verlet, the cheapest method, if it computes all effects and is stable with four times
/// the step. Its steps may be shorter than requested for that. Otherwise uses SDIRK2, solved to rounding by
/// quasi-Newton. Halves Verlet's steps while the extrapolation gains more than `wanted` and each halving helps.
/// @param moments in the scene's steps, ascending, unique
/// @param parts   fewest reference steps per step of the scene, a multiple of four
/// @param wanted  largest gain of the extrapolation at the first moment [m]
/// @returns nothing if stopped
/// @throws DivergedError
std::optional<StepReference> extrapolate_steps(SimulationSettings settings, std::vector<std::int64_t> moments,
                                               std::int64_t parts, double wanted, const std::stop_token& stop,
                                               Progress& progress);

}  // namespace drape
