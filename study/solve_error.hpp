#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "run/progress.hpp"
#include "sim/simulation.hpp"

namespace drape {

/// How far a step's result is from the exact minimiser of g, as means over several states that the step begins in.
struct SolveError {
  double max = 0;       ///< of the vertices' distances [m]
  double rms = 0;       ///< of the vertices' distances [m]
  double gradient = 0;  ///< ‖∇g‖ where the step ends by ‖∇g(y)‖, where its minimisation begins
};

/// Steps from given states, solved by Newton's method to rounding and again by quasi-Newton. A state whose two results
/// differ by more than `limit` is left out: there the minimiser is so flat that errors cannot be told.
class ExactSteps {
 public:
  /// @throws DivergedError
  ExactSteps(const SimulationSettings& settings, const std::vector<State>& states, double limit);

  /// How many states there are, and how many were left out.
  [[nodiscard]] std::size_t count() const { return states_.size(); }
  [[nodiscard]] std::size_t left_out() const { return left_out_; }
  /// How far the two results are apart at most, over all states that are kept [m].
  [[nodiscard]] double apart() const { return apart_; }

  /// The error of an implicit method with its tolerance.
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
