#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "run/progress.hpp"
#include "sim/settings.hpp"
#include "study/energy_over_time.hpp"

namespace drape {

/// What became of a cloth with one step length and one stiffness.
enum class StabilityOutcome {
  stable,         ///< of an explicit method, which has nothing to converge
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
enum class StabilityAxis { springs, push };

/// A method over step lengths and stiffnesses, ascending; the cells row by row, the steps of a row together.
struct StabilityMap {
  StepMethod method = Method::semi_implicit;
  StabilityAxis axis = StabilityAxis::springs;
  std::vector<double> steps, stiffnesses;
  std::vector<StabilityCell> cells;
  std::vector<double> limits;  ///< the predicted largest step of each stiffness [s]; infinite where there is none
  std::string limit_name;      ///< what it is: "safe step"
};

/// Where a method really becomes unstable, beside the step that was predicted.
struct StabilityBorder {
  StepMethod method = Method::semi_implicit;
  StabilityAxis axis = StabilityAxis::springs;
  double stiffness = 0;  ///< what the axis says
  double predicted = 0;  ///< stability_limit() [s]
  double measured = 0;   ///< the longest step without a blow-up in 2000 steps, to 0.2 % [s]
};

/// How finely a study looks.
struct StabilityDetail {
  int per_decade = 3;  ///< step lengths and stiffnesses
  int steps = 100;     ///< of every cell
};

struct StabilityStudy {
  StabilityDetail detail;
  std::vector<StabilityMap> maps;
  std::vector<StabilityBorder> borders;
  std::vector<EnergyCurve> energies;
  double seconds = 0;
};

/// The cloth of the maps: 6×6 cells and 1 kg. Where the stiffness is that of its springs, it hangs from two corners
/// under gravity. Where it is that of a push, its springs have 180 N/m and it lies in a level ground, 1 cm deep under
/// an acceleration that the push just carries there, and swings 0.1 mm to and fro: so the push acts on every vertex all
/// the time, as long as the motion is stable, and step·√stiffness is all that matters.
SimulationSettings stability_cloth(StepMethod method, StabilityAxis axis, double step, double stiffness);

/// The largest step that is predicted to be possible: safe_step() for the explicit methods, 2/√stiffness for an
/// push with the other methods, and else what condition_bound() allows [s].
double stability_limit(StepMethod method, StabilityAxis axis, double stiffness);

/// Runs that cloth and says what became of it.
StabilityCell stability_cell(StepMethod method, StabilityAxis axis, double step, double stiffness, int steps);

/// The largest factor between 0.9 and 1.5 with which there is no blow-up, by bisection to 0.002. If there is none
/// at 1.5 either, it is that.
double stability_border(const std::function<bool(double factor)>& blows_up);
/// The border of a map at a stiffness.
StabilityBorder stability_border(StepMethod method, StabilityAxis axis, double stiffness);

/// What there is to measure: a map for every method over h and k, and over h and the stiffness of a ground's push,
/// explicit and, for the implicit methods, implicit; the border of every map that has one; and what becomes of the
/// energy over time. Its parts are the cells, map by map, then the borders, then the curves.
StabilityStudy plan_stability(const StabilityDetail& detail);

/// How long each part takes, in no unit: steps of an explicit method, roughly.
std::vector<double> stability_costs(const StabilityStudy& study);

/// Measures some of its parts, each of which has the same bits whichever others are measured.
/// @returns whether it was not stopped
bool measure_stability(StabilityStudy& study, const std::vector<std::size_t>& parts, const std::stop_token& stop,
                       Progress& progress);

}  // namespace drape
