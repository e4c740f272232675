#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "run/progress.hpp"
#include "sim/settings.hpp"

namespace drape {

/// What became of a cloth with one step length and one stiffness.
enum class StabilityOutcome {
  stable,         ///< semi-implicit Euler, which has nothing to converge
  converged,      ///< every step met its stopping rule
  not_converged,  ///< it kept within its energy, but a step ended at its cap
  blown_up        ///< more energy than can be explained, or numbers that are not finite
};
const char* outcome_name(StabilityOutcome outcome);

/// A point of a map.
struct StabilityCell {
  double step = 0;       ///< h [s]
  double stiffness = 0;  ///< of the springs [N/m], or of the push [1/s²]
  StabilityOutcome outcome = StabilityOutcome::stable;
  /// The most by which kinetic, gravity, elastic and push energy together differed from what they were, over the most
  /// that moved among them: 0 for an exact motion, 1 where all of it was lost.
  double energy_error = 0;
  int not_converged = 0;  ///< steps
};

/// What is varied beside the step.
enum class StabilityAxis { springs, explicit_push, implicit_push };

/// A method over step lengths and stiffnesses, ascending; the cells row by row, the steps of a row together.
struct StabilityMap {
  Method method = Method::semi_implicit;
  StabilityAxis axis = StabilityAxis::springs;
  std::vector<double> steps, stiffnesses;
  std::vector<StabilityCell> cells;
  std::vector<double> limits;  ///< the predicted largest step of each stiffness [s]; infinite where there is none
  std::string limit_name;      ///< what it is: "safe step"
};

/// Where semi-implicit Euler really becomes unstable, beside the step that was predicted.
struct StabilityBorder {
  double stiffness = 0;  ///< [N/m]
  double predicted = 0;  ///< safe_step() [s]
  double measured = 0;   ///< the longest step without a blow-up in 2000 steps, to 0.5 % [s]
};

struct StabilityStudy {
  std::vector<StabilityMap> maps;
  std::vector<StabilityBorder> borders;
  int steps = 0;  ///< of every cell
  double seconds = 0;
};

/// How finely a study looks.
struct StabilityDetail {
  int per_decade = 2;  ///< step lengths and stiffnesses
  int steps = 100;     ///< of every cell
};

/// The cloth of the maps: 6×6 cells, 1 kg, that hangs from two corners under gravity.
SimulationSettings stability_cloth(Method method, double step, double stiffness);

/// Runs that cloth and says what became of it. The stiffness is what the axis says.
StabilityCell stability_cell(Method method, StabilityAxis axis, double step, double stiffness, int steps);

/// Looks for the border by bisection between 0.9 and 1.5 of the prediction.
StabilityBorder stability_border(double stiffness);

/// Draws a map for every method over h and k, and over h and the stiffness of a sphere's push, explicit and, for the
/// implicit methods, implicit.
/// @returns nothing if it was stopped
std::optional<StabilityStudy> study_stability(const StabilityDetail& detail, const std::stop_token& stop,
                                              Progress& progress);

}  // namespace drape
