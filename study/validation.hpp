#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "run/progress.hpp"
#include "run/shard.hpp"
#include "study/study_motion.hpp"
#include "study/validation_case.hpp"

namespace drape {

/// The factor of runs with a scene as it is, and of those without a key about how to compute.
inline constexpr const char* scene_factor = "scene";
inline constexpr const char* default_factor = "default";

/// One run of one problem, and what became of it.
struct ValidationRun {
  std::string name;                        ///< of its case
  std::string problem;                     ///< of the case
  std::string factor;                      ///< scene_factor, default_factor, "cell", "step", "method", "mesh"
  std::string setting;                     ///< the variant's name; the factor's where it has none
  StudyCase what;                          ///< the command that runs it
  std::optional<std::int64_t> place = {};  ///< in the plan of all shards; absent where there is one

  // What was measured:
  bool measured = false;
  std::string failure;  ///< why there are no values; empty: there are
  double seconds = 0;   ///< computing time, set-up included [s]
  double step = 0;      ///< h [s]
  double cell = 0;      ///< mean length of a spring [m]
  std::int64_t vertices = 0;
  std::int64_t capped = 0;         ///< steps that ended at the cap
  double rest_speed = 0;           ///< of the fastest vertex at the end [m/s]
  std::vector<std::string> names;  ///< of the quantities
  std::vector<double> values;      ///< theirs
  html::PlayedMotion played = {};  ///< of the case's problem that --quick has, as its scene is; not kept in files

  [[nodiscard]] std::optional<double> value(const std::string& quantity) const;
};

/// The options of a study.
struct ValidationOptions {
  std::vector<std::string> cases = {};    ///< empty: all
  std::vector<std::string> methods = {};  ///< of the runs that vary the method; empty: all that a case has
  bool quick = false;                     ///< a few problems as their scenes are, without defaults and variants
  int jobs = 1;                           ///< runs at once
  double patience = 30;                   ///< after so much computing time a run is given up [s]
  Shard shard = {};                       ///< plan these runs alone
};

/// All that a study has measured.
struct ValidationStudy {
  std::vector<ValidationCase> cases;
  std::vector<ValidationRun> runs;  ///< in the order of the plan
  std::string command;              ///< that makes it again
  std::vector<std::pair<std::string, std::string>> provenance;
  double seconds = 0;
  Shard shard = {};  ///< whose runs it has

  /// The run of a problem with its scene as it is, or of another factor; null if there is none.
  [[nodiscard]] const ValidationRun* run(const std::string& name, const std::string& problem,
                                         const std::string& factor = scene_factor) const;
};

/// Plans the runs: every problem as its scene is and by default, and one factor at a time. Shards take about as long,
/// as far as steps and vertices tell.
/// @throws UsageError for an unknown case or method, or a scene that is wrong
ValidationStudy plan_validation(const ValidationOptions& options);

/// Does what is not measured yet.
/// @param save called after every run, by one thread at a time
/// @returns whether it came to its end
bool measure_validation(ValidationStudy& study, const ValidationOptions& options, const std::stop_token& stop,
                        Progress& progress, const std::function<void()>& save);

/// How far a value is from an answer, in tolerances.
double in_tolerances(const KnownAnswer& answer, double value);

}  // namespace drape
