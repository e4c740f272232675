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

/// A planned run of a sweep.
struct PlannedRun {
  std::size_t scene = 0;            ///< index in the request
  std::vector<std::string> values;  ///< values of the varied keys, in their order
  std::vector<std::string>
      shared;  ///< overrides that name the method which all runs share, see shared_method_overrides()
  /// Hash of the resolved scene with its files, the program, the request, and the run that decides the viewing
  /// direction. Written as 16 hexadecimal digits; also the name of the run's folder.
  std::string key;
  std::string refusal;  ///< reason why it cannot run, see SceneConflict; empty: none
  double cost = 0;      ///< expected time, see estimated_cost() [s]
};

/// A checked plan of all runs of a sweep.
struct SweepPlan {
  SweepRequest request;
  std::string program;             ///< version, revision and compiler of the planning program
  std::vector<std::string> names;  ///< distinct names of the scenes
  std::vector<PlannedRun> runs;
  std::optional<std::size_t> side;  ///< the run that decides the viewing direction of films, see chooses_side()
};

/// Returns the overrides of a run.
std::vector<std::string> overrides_of(const SweepPlan& plan, const PlannedRun& run);

/// Returns "integrator.tolerance = 0.01, integrator.method = liu13", with the scene's name if there are several.
std::string label_of(const SweepPlan& plan, const PlannedRun& run);

/// Returns the shell command that makes this run alone, with its films or its motion.
std::string run_command(const SweepPlan& plan, const PlannedRun& run);

/// Returns the version, revision and compiler of this program for plans. A build of a modified source tree also
/// includes the hash of the program file.
std::string program_text();

/// Returns the hash of a scene and the request, independent of the other runs.
std::string run_key(const LoadedScene& scene, const SweepRequest& request, const std::string& program);
/// Returns the key of a run; the earlier runs of the plan must have keys.
std::string run_key(const LoadedScene& scene, const SweepPlan& plan);

/// Resolves every run's scene and finds all errors before the first run: unknown keys, values out of range, impossible
/// films. A conflict of valid values, such as a step too long for the method, refuses only that run. A conflict in all
/// runs is an error.
/// @throws Error with every problem of all runs once, and the runs affected
SweepPlan make_plan(const SweepRequest& request);

/// Returns the runs of a plan in a shard, ascending.
std::vector<std::size_t> runs_of_shard(const SweepPlan& plan, const Shard& shard);

/// Returns a plan as JSON.
nlohmann::ordered_json plan_json(const SweepPlan& plan);
/// Reads a plan from JSON.
/// @throws std::exception of the JSON library if a member is missing
SweepPlan plan_of(const nlohmann::ordered_json& json);

}  // namespace drape
