#include "cli/scene_run.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "cli/inputs.hpp"
#include "cli/summary.hpp"
#include "cli/terminal.hpp"
#include "core/console.hpp"
#include "core/text.hpp"
#include "drape/scene/document.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/simulation.hpp"
#include "run/outputs.hpp"
#include "run/progress.hpp"
#include "run/run_scene.hpp"
#include "scene/table_reader.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/stability.hpp"
#include "sim/start_overlap.hpp"
#include "sim/system.hpp"

namespace drape {

void Separation::begin(const Simulation& simulation) {
  parts_.clear();
  for (const StartOverlap& start : start_overlaps(simulation.settings())) {
    if (!start.overlap.contact) continue;
    parts_.push_back({start.effect, describe(start, simulation.settings()), std::nullopt});
  }
  if (next_ != nullptr) next_->begin(simulation);
}

void Separation::replay(const StepRow& row, double time, double seconds) {
  if (next_ != nullptr) next_->replay(row, time, seconds);
}

void Separation::after_step(const Simulation& simulation, const StepReport& report, double seconds) {
  if (next_ != nullptr) next_->after_step(simulation, report, seconds);
  for (Part& part : parts_) {
    if (part.separated) continue;
    const double time = simulation.time();
    if (!find_overlap(simulation.settings(), part.effect, simulation.state().x, time)) part.separated = time;
  }
}

std::vector<std::string> Separation::lines() const {
  std::vector<std::string> lines;
  for (const Part& part : parts_) {
    lines.push_back(fmt::format("begins with {}: {}", part.text,
                                part.separated ? fmt::format("separated after {:.3g} s", *part.separated)
                                               : std::string("not separated at the end")));
  }
  return lines;
}

namespace {

class Advice {
 public:
  Advice(const LoadedScene& scene, const TomlValue& document)
      : scene_(scene), document_(document), problems_(scene.source.file, {}), system_(make_system(scene.simulation)) {}

  std::vector<std::string> all() && {
    std::vector<std::string> warnings = scene_.source.warnings;
    without_effect();
    camera();
    steps();
    thickness();
    for (const StartOverlap& overlap : start_overlaps(scene_.simulation)) {
      found_.push_back(fmt::format("{}: {}", shown(scene_.source.file), overlap_advice(overlap, scene_.simulation)));
    }
    warnings.insert(warnings.end(), found_.begin(), found_.end());
    return warnings;
  }

 private:
  [[nodiscard]] const TomlValue* given(const std::string& key) const { return find_path(document_, key); }

  [[nodiscard]] bool has(std::string_view effect) const {
    return std::ranges::any_of(scene_.simulation.effects, [&](const Effect& e) { return e.name() == effect; });
  }

  void add(const std::string& key, const std::string& sentence) {
    const std::size_t dot = key.rfind('.');
    const TomlValue* table = given(key.substr(0, dot));
    const std::string name = key.substr(dot + 1);
    found_.push_back(fmt::format(
        "{}: {}: {}", problems_.text(table == nullptr ? document_.place : place_of(*table, name)), name, sentence));
  }

  void unless(bool effective, std::initializer_list<const char*> keys, const char* reason) {
    for (const char* key : keys) {
      if (!effective && given(key) != nullptr) add(key, fmt::format("it has no effect {}", reason));
    }
  }

  void without_effect() {
    const Look& look = scene_.look;
    const IntegratorSettings& integrator = scene_.simulation.integrator;
    unless(look.mesh_lines, {"look.line_color", "look.line_width"}, "without mesh_lines = true");
    unless(look.color_by.has_value(), {"look.color_limit"}, "without color_by");
    unless(!look.color_by, {"look.color", "look.texture"}, "beside color_by, which colours the cloth");
    unless(!look.texture.empty(), {"look.anisotropy"}, "without a texture");
    unless(has("ground"), {"look.ground_color", "look.ground_grid"}, "without [effects.ground]");
    unless(has("sphere"), {"look.sphere_color"}, "without [effects.sphere]");
    unless(has("body"), {"look.body_color"}, "without [effects.body]");
    unless(!scene_.camera.position, {"camera.azimuth", "camera.elevation", "camera.margin"},
           "beside position, which places the camera");
    unless(!is_explicit(integrator.method), {"integrator.tolerance", "integrator.max_iterations"},
           "with an explicit method, which solves nothing");
    unless(integrator.method == Method::implicit, {"integrator.linear_solver"}, "without method = \"implicit\"");
    unless(!scene_.caption.text.empty(), {"caption.place", "caption.size", "caption.color", "caption.backing"},
           "without a text");
  }

  /// Warns about a camera inside an object, which hides everything else.
  void camera() {
    if (!scene_.camera.position) return;
    const Eigen::RowVector3d eye = scene_.camera.position->transpose();
    const Vertices& x = scene_.simulation.cloth.positions;
    constexpr double close = 0.1;  // relative to the cloth's size
    const double distance = (x.rowwise() - eye).rowwise().norm().minCoeff(), size = size_of(scene_.simulation.cloth);
    const bool within =
        (eye.array() >= x.colwise().minCoeff().array()).all() && (eye.array() <= x.colwise().maxCoeff().array()).all();
    if (within || distance < close * size) {
      add("camera.position",
          fmt::format("the camera is {} the cloth, {:.2g} m from its nearest vertex: leave it out, and it is placed so "
                      "that the whole motion is in view",
                      within ? "inside" : "close to", distance));
    }
    for (const Collider& collider : system_.colliders_at(0)) {
      const auto* sphere = std::get_if<SphereShape>(&collider);
      const auto* ground = std::get_if<GroundShape>(&collider);
      if (sphere != nullptr && (sphere->center.transpose() - eye).norm() < sphere->radius) {
        add("camera.position", "the camera is inside a sphere");
      }
      if (ground != nullptr && ground->normal.dot(eye.transpose()) < ground->height) {
        add("camera.position", "the camera is below the ground");
      }
    }
  }

  void steps() {
    constexpr double many = 100;
    const SimulationSettings& settings = scene_.simulation;
    const double step = settings.step, per_frame = scene_.video.speed / scene_.video.fps;
    if (step > per_frame * (1 + 1e-9)) {
      add("time.step", fmt::format("steps are longer than the {:.3g} s between frames, so the film shows straight ways "
                                   "between them; try step = {:.2g}",
                                   per_frame, per_frame));
    }
    if (is_explicit(settings.integrator.method) || settings.accuracy) return;
    const double safe = safe_step(system_);
    if (!(safe > 0) || step <= many * safe) return;  // 0: a field of unknown gradient
    add("time.step",
        fmt::format("{:g} s is {:.0f} times what the springs' vibrations take, so backward Euler damps motion that is "
                    "not theirs as well; try step = {:.1g}, a smaller stiffness, or [integrator] scheme = \"sdirk2\"",
                    step, step / safe, many / 2 * safe));
  }

  /// Warns about layers so thick that neighbours within a flat cloth touch each other.
  void thickness() {
    constexpr double nearest = 0.7;  // distance of features without a common vertex at rest, in edges of a grid
    const Cloth& cloth = scene_.simulation.cloth;
    double sum = 0;
    for (const Triangle& t : cloth.triangles) {
      for (std::size_t c = 0; c < 3; ++c) sum += (cloth.rest.row(t[c]) - cloth.rest.row(t[(c + 1) % 3])).norm();
    }
    const double edge = sum / (3 * static_cast<double>(cloth.triangles.size()));
    for (const Effect& effect : scene_.simulation.effects) {
      const auto* layers = effect.as<SelfCollision>();
      if (layers == nullptr || !(layers->thickness > nearest * edge)) continue;
      add("effects.self_collision.thickness",
          fmt::format(
              "{:g} m is more than {:.2g} m, at which neighbours within the cloth touch each other, as its edges "
              "have {:.2g} m: each step takes much longer; try thickness = {:.1g}, or a coarser mesh",
              layers->thickness, nearest * edge, edge, nearest / 2 * edge));
    }
  }

  const LoadedScene& scene_;
  const TomlValue& document_;
  Problems problems_;
  System system_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> advice_on(const LoadedScene& scene, const TomlValue& document) {
  return Advice(scene, document).all();
}

std::string advice_on_pace(const Scene& scene) {
  using Clock = std::chrono::steady_clock;
  constexpr double enough = 1, long_run = 30;  // time for the trial, and a long run [s]
  Pace pace;
  pace.left = scene.step_count();
  Simulation simulation(scene.simulation);
  const auto begin = Clock::now();
  while (pace.left > 0 && pace.seconds < enough) {
    const StepReport report = simulation.step();
    ++pace.steps;
    --pace.left;
    pace.iterations += report.iterations;
    pace.substeps += static_cast<double>(report.substeps);
    pace.seconds = pace.simulated = std::chrono::duration<double>(Clock::now() - begin).count();
  }
  return pace.steps > 0 && pace.whole() >= long_run ? describe_pace(pace, scene.simulation) : std::string();
}

namespace {

/// Returns the command that resumes a run from its motion file and makes its records and other outputs.
std::string resume_command(const RunArguments& arguments, const std::string& motion) {
  std::string text;
  const auto add = [&text](const char* option, const std::string& value) {
    if (!value.empty()) text += fmt::format(" {} {}", option, shell_word(value));
  };
  for (const std::string& path : arguments.outputs) {
    if (!is_motion_file(path)) add("-o", path);
  }
  const bool drawn = arguments.drawing && !text.empty();  // render without -o would make a film
  if (!text.empty()) {                                    // options that shape outputs
    add("--every", arguments.every);
    add("--frames", arguments.frames);
    add("--at", arguments.times.at);
    add("--from", arguments.times.from);
    add("--to", arguments.times.to);
    add("--sheet", arguments.sheet);
    add("--max-size", arguments.max_size);
    add("--keep", arguments.keep);
    add("--start", arguments.start);
    if (arguments.poster) text += " --poster";
  }
  add("--stats", arguments.records.stats);
  add("--energies", arguments.records.energies);
  add("--positions", arguments.records.positions);
  add("--trace", arguments.records.trace);
  return fmt::format("drape {} --resume {}{}", drawn ? "render" : "simulate", shell_word(motion), text);
}

}  // namespace

SceneRun::SceneRun(const LoadedScene& scene, RunOptions options, const RunArguments& arguments,
                   const CommonOptions& common)
    : scene_(scene),
      options_(std::move(options)),
      arguments_(arguments),
      common_(common),
      quiet_(common.quiet || arguments.step_by_step),
      pause_(interruption()),
      slow_(film_extent(scene, options_).steps, needs_drawing(options_),
            [&scene](const std::string& text) { spdlog::info("{}: {}", shown(scene.source.file), text); }) {
  options_.observer = &separation_;
  separation_.tell_also(slow_);
  if (arguments.step_by_step) separation_.tell_also(pause_);
}

void SceneRun::announce() const {
  spdlog::info(describe(scene_, options_));
  for (const std::string& warning : scene_.source.warnings) spdlog::warn(warning);
  if (scene_.simulation.integrator.allow_unstable) {
    if (const auto problem = stability_problem(scene_.simulation, make_system(scene_.simulation))) {
      spdlog::warn("{}: {}", shown(scene_.source.file), *problem);
    }
  }
  if (!options_.recorded) {
    for (const StartOverlap& overlap : start_overlaps(scene_.simulation)) {
      spdlog::warn("{}: {}", shown(scene_.source.file), overlap_advice(overlap, scene_.simulation));
    }
  }
  if (options_.motion) {
    const MotionSpace space = motion_space(scene_, options_);
    if (space.most > space.free) spdlog::warn(space.text(options_.motion->path));
  }
  if (options_.recorded) warn_of_gaps(shown(scene_.source.file), *options_.recorded, film_extent(scene_, options_));
}

void SceneRun::begin() {
  if (work_) return;
  work_.emplace([this](const std::stop_token& stop, Progress& progress) {
    result_ = run_scene(scene_, options_, stop, progress);
  });
}

ExitCode SceneRun::end() {
  work_->watch_to_its_end(quiet_);
  if (!result_.renderer.empty()) spdlog::debug("drawn by {}", result_.renderer);
  if (common_.verbose) spdlog::debug(effect_shares(result_.statistics));
  if (!common_.quiet && (result_.statistics.steps() > 0 || options_.recorded || !result_.outputs.empty())) {
    print_wrapped(stderr, summarize(result_) + "\n");
    for (const std::string& line : separation_.lines()) print_wrapped(stderr, line + "\n");
  }
  for (const std::string& warning : warnings(result_)) spdlog::warn("{}: {}", shown(scene_.source.file), warning);
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
      spdlog::error("{}: {}", shown(scene_.source.file), result_.divergence);
      spdlog::error("ended {}", describe_end(result_));
      return std::max(outputs, ExitCode::diverged);
  }
  return outputs;
}

}  // namespace drape
