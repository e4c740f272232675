#pragma once

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "sweep/plan.hpp"
#include "sweep/results.hpp"
#include "sweep/run_sweep.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape::test {

/// A cloth of four cells that falls for ten steps.
const std::string tiny_scene =
    least_scene + "duration = 0.1\n[integrator]\nmethod = \"liu13\"\n[effects.gravity]\n[video]\nsize = [64, 48]\n";

/// Makes a request of one scene with variations, as on a command line.
inline SweepRequest request_of(const std::filesystem::path& scene, const std::vector<std::string>& varied) {
  SweepRequest request;
  request.scenes = {scene.string()};
  for (const std::string& text : varied) request.varied.push_back(parse_variation(text));
  return request;
}

/// Runs a sweep to its end.
inline SweepResults sweep(const SweepRequest& request, SweepOptions options) {
  const SweepPlan plan = make_plan(request);
  const std::stop_source never;
  Progress progress;
  write_sweep_file(options.folder, {plan, options.shard});
  const auto unwritten = run_sweep(plan, options, never.get_token(), progress);
  return read_results(options.folder, {plan, options.shard}, unwritten);
}

/// Returns the lines of runs.csv without measured times: columns step_us.…, effect_shares.…, seconds and timed. Cells
/// must not contain commas.
inline std::vector<std::string> without_times(const std::string& csv) {
  std::vector<std::string> lines;
  std::vector<bool> kept;
  std::istringstream text(csv);
  for (std::string line; std::getline(text, line);) {
    std::istringstream cells(line);
    std::string rest;
    std::size_t column = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++column) {
      if (lines.empty()) {
        kept.push_back(!cell.starts_with("step_us.") && !cell.starts_with("effect_shares.") && cell != "seconds" &&
                       cell != "timed");
      }
      if (kept.at(column)) rest += cell + ",";
    }
    lines.push_back(rest);
  }
  return lines;
}

}  // namespace drape::test
