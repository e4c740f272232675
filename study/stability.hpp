#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "drape/sim/settings.hpp"
#include "run/progress.hpp"
#include "run/shard.hpp"
#include "study/motions.hpp"

namespace drape {

struct StudyReport;

/// The outcome of a run with one step length and one stiffness.
enum class StabilityOutcome {
  stable,         ///< bounded energy, by an explicit method
  converged,      ///< every step met its stopping criterion
  not_converged,  ///< bounded energy, but a step reached its iteration limit
  blown_up        ///< unexplained energy, or non-finite numbers
};
const char* outcome_name(StabilityOutcome outcome);

/// A cell of a stability map.
struct StabilityCell {
  double step = 0;       ///< step length h [s]
  double stiffness = 0;  ///< spring stiffness [N/m], or push stiffness [1/s²]
  StabilityOutcome outcome = StabilityOutcome::stable;
  /// Largest change of kinetic, gravity, elastic and push energy together, relative to the largest exchanged energy. It
  /// is 0 for an exact motion, and 1 if all energy was lost.
  double energy_error = 0;
  int not_converged = 0;  ///< number of steps
};

/// The quantity varied beside the step length.
enum class StabilityAxis { springs, push };

/// A method over step lengths and stiffnesses, both ascending; cells in row order, one row per stiffness.
struct StabilityMap {
  StepMethod method = Method::semi_implicit;
  StabilityAxis axis = StabilityAxis::springs;
  std::vector<double> steps, stiffnesses;
  std::vector<StabilityCell> cells;
  std::vector<double> limits;  ///< predicted largest step for each stiffness [s]; infinite if unlimited
  std::string limit_name;      ///< name of the prediction: "safe step"
};

/// The measured stability limit of a method, beside the predicted one.
struct StabilityLimit {
  StepMethod method = Method::semi_implicit;
  StabilityAxis axis = StabilityAxis::springs;
  double stiffness = 0;  ///< stiffness in the unit of the axis
  double predicted = 0;  ///< stability_limit() [s]
  double measured = 0;   ///< longest step without a blow-up in 2000 steps, to 0.2 % [s]
};

/// Energy of a cloth over time, for a method and a step length.
struct EnergyCurve {
  StepMethod method = Method::verlet;
  double step = 0;                    ///< step length h [s]
  std::vector<double> times = {};     ///< [s]
  std::vector<double> energies = {};  ///< change of K + E + gravity's, over the largest drop of gravity's [1]
};

/// Resolution of a study.
struct StabilityDetail {
  int per_decade = 3;  ///< numbers of step lengths and of stiffnesses
  int steps = 100;     ///< steps per cell

  bool operator==(const StabilityDetail&) const = default;
};

struct StabilityStudy {
  StabilityDetail detail;
  std::vector<StabilityMap> maps;
  std::vector<StabilityLimit> borders;
  std::vector<EnergyCurve> energies;
  double seconds = 0;
};

/// Returns the cloth of the maps, 6×6 cells and 1 kg. On the springs axis it hangs from two corners under gravity. On
/// the push axis its springs have 180 N/m and it lies 1 cm deep in a level ground, in equilibrium with gravity. It then
/// oscillates by 0.1 mm. The push thus acts on every vertex at all times while the motion is stable, and only
/// step·√stiffness matters.
SimulationSettings stability_cloth(StepMethod method, StabilityAxis axis, double step, double stiffness);

/// Returns the predicted largest step [s]: safe_step() for explicit methods, 2/√stiffness for a push with other
/// methods, otherwise the limit of condition_bound().
double stability_limit(StepMethod method, StabilityAxis axis, double stiffness);

/// Runs that cloth and returns the outcome.
StabilityCell stability_cell(StepMethod method, StabilityAxis axis, double step, double stiffness, int steps);

/// Returns the largest factor from 0.9 to 1.5 without a blow-up, by bisection to 0.002; 1.5 if that does not blow up.
double stability_border(const std::function<bool(double factor)>& blows_up);
/// Measures the stability limit of a map at a stiffness.
StabilityLimit stability_border(StepMethod method, StabilityAxis axis, double stiffness);

/// Plans the study. Every method gets a map over h and k, and one over h and the stiffness of a ground's push.
/// Stability limits and the energy over time follow. The order of the parts is: cells, map by map; limits; curves.
StabilityStudy plan_stability(const StabilityDetail& detail);

/// Returns the relative cost of each part, about in steps of an explicit method.
std::vector<double> stability_costs(const StabilityStudy& study);

/// Measures some of the parts. A part's bits do not depend on the other parts measured.
/// @returns false if stopped
bool measure_stability(StabilityStudy& study, const std::vector<std::size_t>& parts, const std::stop_token& stop,
                       Progress& progress);

/// File name of the measurements of a shard of a stability study.
inline constexpr const char* stability_runs_name = "stability-runs.csv";

/// Returns the parts of a study in a shard, ascending.
std::vector<std::size_t> parts_of_shard(const StabilityStudy& study, const Shard& shard);

/// Returns the measurements of a study, as RunsWriter writes them.
/// @param shard that was measured
std::string stability_runs(const StabilityStudy& study, const Shard& shard);

/// A study merged from shards.
struct MergedStability {
  StabilityStudy study;
  std::vector<Shard> missing;  ///< shards without measurements
};

/// Reads and merges the measurements of shards.
/// @param files at least one
/// @throws UsageError if a file is damaged, or they belong to different studies or programs
MergedStability merge_stability(const std::vector<std::filesystem::path>& files);

/// Returns the report of a study for all output formats.
StudyReport stability_report(const StabilityStudy& study);

/// Returns two motions of the stability maps' cloth by semi-implicit Euler, with 0.95 and 1.2 times the safe step. The
/// second ends early, with its blow-up.
std::vector<StudyMotion> limit_motions();

}  // namespace drape
