#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "run/progress.hpp"
#include "sim/simulation.hpp"

namespace drape {

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

}  // namespace drape
