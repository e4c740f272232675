#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "run/shard.hpp"
#include "sweep/request.hpp"

namespace drape {

/// One run of a sweep, before it is run.
struct PlannedRun {
  std::size_t scene = 0;            ///< its place in the request
  std::vector<std::string> values;  ///< of the keys that vary, in their order
  /// A hash of the resolved scene with the files it names, of the program and of what is asked of it, and of the run
  /// that says from which side it is seen: 16 hexadecimal digits. The name of its folder.
  std::string key;
  std::string refusal;  ///< why it cannot be run, see SceneConflict; empty: it can be run
  double cost = 0;      ///< how long it will take, see estimated_cost() [s]
};

/// All that a sweep will do, checked.
struct SweepPlan {
  SweepRequest request;
  std::string program;             ///< that made it, with its revision and compiler
  std::vector<std::string> names;  ///< of the scenes, which tell them apart
  std::vector<PlannedRun> runs;
  std::optional<std::size_t> side;  ///< the first run whose film has a side chosen, for all: see chooses_side()
};

/// The overrides of a run.
std::vector<std::string> overrides_of(const SweepPlan& plan, const PlannedRun& run);

/// "integrator.tolerance = 0.01, integrator.method = liu13", with the scene's name where there are several.
std::string label_of(const SweepPlan& plan, const PlannedRun& run);

/// The version, revision and compiler of this program, as plans have them; where files were changed since that
/// revision, also what the program's file is.
std::string program_text();

/// The hash of a scene and what is asked of it, whatever the other runs are.
std::string run_key(const Scene& scene, const SweepRequest& request, const std::string& program);
/// The key of a run of a plan, of which the runs before it are known.
std::string run_key(const Scene& scene, const SweepPlan& plan);

/// Resolves every run's scene and looks for all that is wrong before the first one runs: unknown keys, values out of
/// range, films that cannot be made. Values that are valid, but not together, are no mistake, as where a step is too
/// long for a method: that run is refused, unless all are.
/// @throws Error with every problem of all runs once, and in which of them it is
SweepPlan make_plan(const SweepRequest& request);

/// Which of a plan's runs are in a shard, ascending.
std::vector<std::size_t> runs_of_shard(const SweepPlan& plan, const Shard& shard);

/// A plan as JSON, and from it.
nlohmann::ordered_json plan_json(const SweepPlan& plan);
/// @throws std::exception of the JSON library where something is missing
SweepPlan plan_of(const nlohmann::ordered_json& json);

}  // namespace drape
