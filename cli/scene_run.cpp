#include "cli/scene_run.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "cli/interruption.hpp"
#include "cli/motion_runs.hpp"
#include "cli/open_file.hpp"
#include "cli/summary.hpp"
#include "cli/terminal.hpp"
#include "core/shell.hpp"
#include "core/text.hpp"
#include "run/motion_space.hpp"
#include "run/outputs.hpp"
#include "sim/make_system.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/simulation.hpp"
#include "sim/start_overlap.hpp"

namespace drape {
namespace {

/// Returns the command that resumes a run from its motion file and makes its other outputs.
std::string resume_command(const RunArguments& arguments, const std::string& motion) {
  std::string text = fmt::format("drape {} --resume {}", arguments.drawing ? "render" : "simulate", shell_word(motion));
  for (const std::string& path : arguments.outputs) {
    if (!is_motion_file(path)) text += " -o " + shell_word(path);
  }
  return text;
}

}  // namespace

SceneRun::SceneRun(const Scene& scene, RunOptions options, const RunArguments& arguments, const CommonOptions& common)
    : scene_(scene),
      options_(std::move(options)),
      arguments_(arguments),
      common_(common),
      quiet_(common.quiet || arguments.step_by_step),
      pause_(interruption()),
      slow_(film_extent(scene, options_).steps, needs_drawing(options_),
            [&scene](const std::string& text) { spdlog::info("{}: {}", shown(scene.file), text); }) {
  options_.observer = &separation_;
  separation_.tell_also(slow_);
  if (arguments.step_by_step) separation_.tell_also(pause_);
}

void SceneRun::announce() const {
  spdlog::info(describe(scene_, options_));
  for (const std::string& doubt : scene_.warnings) spdlog::warn(doubt);
  if (scene_.simulation.integrator.allow_unstable) {
    if (const auto problem = stability_problem(scene_.simulation, make_system(scene_.simulation))) {
      spdlog::warn("{}: {}", shown(scene_.file), *problem);
    }
  }
  if (!options_.recorded) {
    for (const StartOverlap& overlap : start_overlaps(scene_.simulation)) {
      spdlog::warn("{}: {}", shown(scene_.file), overlap_advice(overlap, scene_.simulation));
    }
  }
  if (options_.motion) {
    const MotionSpace space = motion_space(scene_, options_);
    if (space.most > space.free) spdlog::warn(space.text(options_.motion->path));
  }
  if (options_.recorded) warn_of_gaps(shown(scene_.file), *options_.recorded, film_extent(scene_, options_));
}

void SceneRun::begin() {
  if (work_) return;
  work_.emplace([this](const std::stop_token& stop, Progress& progress, const std::function<void()>& drawn) {
    options_.drawn = drawn;
    result_ = run_scene(scene_, options_, stop, progress);
  });
}

ExitCode SceneRun::end() {
  work_->watch_to_its_end(quiet_);
  if (!result_.renderer.empty()) spdlog::debug("drawn by {}", result_.renderer);
  if (common_.verbose) spdlog::debug(effect_shares(result_.statistics));
  if (!common_.quiet && (result_.statistics.steps() > 0 || options_.recorded)) {
    print_wrapped(stderr, summarize(result_) + "\n");
    for (const std::string& line : separation_.lines()) print_wrapped(stderr, line + "\n");
  }
  for (const std::string& doubt : warnings(result_)) spdlog::warn("{}: {}", shown(scene_.file), doubt);
  return conclude();
}

ExitCode SceneRun::conclude() const {
  for (const std::string& problem : result_.problems) spdlog::error(problem);
  const ExitCode outputs = result_.problems.empty() ? ExitCode::ok : ExitCode::output;
  switch (result_.outcome) {
    case Outcome::completed:
      if (arguments_.open && !result_.outputs.empty()) open_file(result_.outputs.front().front().path.string());
      return outputs;
    case Outcome::interrupted:
      spdlog::error("interrupted {}",
                    describe_end(result_, resume_command(arguments_, result_.motion ? result_.motion->file : "")));
      return ExitCode::interrupted;
    case Outcome::diverged:
      spdlog::error("{}: {}", shown(scene_.file), result_.divergence);
      spdlog::error("ended {}", describe_end(result_));
      return std::max(outputs, ExitCode::diverged);
  }
  return outputs;
}

}  // namespace drape
