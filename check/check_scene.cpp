#include "check/check_scene.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <thread>
#include <vector>

#include "check/candidate.hpp"
#include "check/compare_motion.hpp"
#include "check/draw_frames.hpp"
#include "check/golden.hpp"
#include "check/golden_motion.hpp"
#include "check/name_difference.hpp"
#include "check/picture.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/settings.hpp"
#include "drape/sim/simulation.hpp"
#include "run/frame_source.hpp"
#include "run/outputs.hpp"
#include "scene/motion_scene.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

std::size_t thread_count(const CheckOptions& options) {
  return options.threads > 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
}

/// Returns a result with the scene's data before the check.
SceneResult unchecked(const LoadedScene& scene, const std::string& name, const CheckSettings& settings) {
  SceneResult result;
  result.name = name;
  result.file = scene.source.file;
  result.golden = golden_folder(scene.source.file);
  result.settings = settings;
  const Eigen::Vector2i size = picture_size(scene, settings);
  result.size = {size.x(), size.y()};
  return result;
}

/// The check of one scene, from its golden to its verdict.
class SceneCheck {
 public:
  SceneCheck(const LoadedScene& scene, const std::string& name, const CheckSettings& settings, PlayedMotion* recorded,
             const CheckOptions& options, const std::stop_token& stop, Progress& progress)
      : scene_(scene),
        settings_(settings),
        recorded_(recorded),
        options_(options),
        stop_(stop),
        progress_(progress),
        result_(unchecked(scene, name, settings)) {}

  SceneResult run() {
    if (!options_.artefacts.empty()) remove_candidate(options_.artefacts, result_.name);
    if (!has_golden(result_.golden)) {
      miss();
    } else if (options_.update == UpdateMode::all) {
      update(FindingKind::recorded_again);
    } else {
      compare();
    }
    return std::move(result_);
  }

 private:
  void miss() {
    result_.verdict = SceneVerdict::missing;
    if (options_.update == UpdateMode::none || overridden()) {
      add(FindingKind::no_golden);
    } else if (options_.update == UpdateMode::missing) {
      bless_scene(scene_, scene_.check, options_.backend, stop_, progress_, recorded_);
      add(FindingKind::first_golden);
    } else {
      update(FindingKind::recorded);
    }
  }

  void update(FindingKind what) {
    const auto blessing = bless_scene(scene_, scene_.check, options_.backend, stop_, progress_, recorded_);
    if (!blessing) return;
    result_.verdict = SceneVerdict::updated;
    add(what);
  }

  void compare() {
    golden_ = read_golden(result_.golden);
    if (scene_.choice) use_recorded_method();
    if (recorded_ != nullptr) match_vertices_of_golden();
    check_precision();
    check_time_is_there();
    frames_ = chosen_frames(golden_, options_.frames, result_.golden);
    result_.recorded_at = golden_.date;
    result_.recorded_on = golden_.machine;
    result_.checked_on = this_machine({});
    result_.ignored = covered_part(settings_.ignore, golden_.size);
    result_.scene_changed = golden_.scene_digest != digest_without_overrides();

    const std::optional<Difference> another_motion = motion_mismatch(scene_, golden_);
    const std::optional<Difference> other_pictures =
        picture_mismatch(scene_, settings_, golden_, !options_.frames.empty());
    if (another_motion) {
      result_.windows.motion = MotionVerdict::changed;
      add(FindingKind::incomparable, {}, *another_motion);
    } else {
      compare_window_motion();
    }
    if (!stop_.stop_requested()) {
      if (other_pictures) {
        result_.windows.picture = PictureVerdict::changed;
        add(FindingKind::incomparable, {}, *other_pictures);
      } else {
        compare_golden_pictures();
      }
    }
    result_.film = film_mismatch(scene_, settings_, golden_);
    if (!result_.film.empty()) add(FindingKind::film);
    if (!another_motion) compare_time();
    if (options_.end_to_end && recorded_ == nullptr && !another_motion && !other_pictures && !stop_.stop_requested()) {
      compare_end_to_end();
    }
    conclude();
  }

  /// Sets the golden's method for a scene that names none.
  void use_recorded_method() {
    const GoldenMethod recorded = golden_.method.value_or(GoldenMethod{});
    IntegratorSettings& integrator = scene_.simulation.integrator;
    if (recorded.method == integrator.method && recorded.substeps == integrator.substeps) return;
    const auto text = [](Method method, std::optional<int> substeps) {
      return method_name(method) + (substeps ? fmt::format(" in {} substeps", *substeps) : "");
    };
    result_.findings.push_back(
        {FindingKind::method, text(integrator.method, integrator.substeps), text(recorded.method, recorded.substeps)});
    integrator.method = recorded.method;
    integrator.substeps = recorded.substeps;
    const bool solved = scene_.simulation.accuracy && !is_explicit(integrator.method);
    integrator.scheme = solved ? TimeScheme::sdirk2 : TimeScheme::backward_euler;
  }

  /// Reorders the vertices of a motion that starts like the golden one, but with its vertices in another order.
  void match_vertices_of_golden() {
    Cloth& cloth = scene_.simulation.cloth;
    const Vertices &golden = golden_.windows.front().start.x, actual = recorded_->state(0).x;
    if (golden.rows() != actual.rows()) return;
    constexpr double same_place = 1e-3;  // edges
    const double tolerance = std::max(settings_.motion_tolerance, same_place * mean_edge(actual, cloth.triangles));
    if ((golden - actual).rowwise().norm().maxCoeff() <= tolerance) return;
    const std::optional<VertexOrder> order = match_vertices(golden, actual, tolerance);
    if (!order) return;
    recorded_->set_order(*order);
    cloth = in_order(std::move(cloth), *order);
    add(FindingKind::vertex_order);
  }

  [[nodiscard]] bool overridden() const { return !options_.overrides.empty(); }

  /// Returns the digest of the scene file without overrides. If it is no valid scene on its own, returns the golden's
  /// digest: the file then counts as unchanged.
  [[nodiscard]] std::string digest_without_overrides() const {
    if (!overridden() || scene_.source.digest == no_scene_digest) return scene_.source.digest;
    try {
      return digest_of_file(scene_.source.file);
    } catch (const UsageError&) {
      return golden_.scene_digest;
    }
  }

  void check_precision() const {
    if (settings_.motion_tolerance > 0 && settings_.motion_tolerance < 2 * golden_.quanta.compared) {
      throw UsageError(
          fmt::format("{} stores positions to {:.2g} m, which is too coarse for a motion_tolerance of {:g} m; bless "
                      "the scene with that tolerance, or set it to 0 for the same bits",
                      shown(result_.golden), golden_.quanta.compared, settings_.motion_tolerance));
    }
  }

  void check_time_is_there() const {
    if (!settings_.time || golden_.time || golden_.step_count == 0 || recorded_ != nullptr) return;
    throw UsageError(
        fmt::format("{} holds no time to compare with, as [check] had no 'time' when it was recorded; record it again "
                    "with drape bless",
                    shown(result_.golden)));
  }

  /// Compares times of equal instruction sets only: one with half the vector width may take twice as long.
  void compare_time() {
    if (!settings_.time || !golden_.time || stop_.stop_requested() || recorded_ != nullptr) return;
    if (golden_.machine.kernels != result_.checked_on.kernels) return add(FindingKind::not_timed);
    try {
      result_.time = time_mismatch(scene_, *golden_.time, *settings_.time, stop_);
    } catch (const DivergedError&) {
      return;  // reported with the motion
    }
    if (result_.time) add(FindingKind::slow);
  }

  void compare_window_motion() {
    if (recorded_ != nullptr) {
      const auto read = record_motion(scene_, settings_, plan_of(golden_), stop_, progress_, recorded_);
      if (!read) return;
      result_.windows.windows = compare_whole(scene_.simulation, golden_, *read, settings_.motion_tolerance);
    } else {
      progress_.begin("checking", "windows", static_cast<std::int64_t>(golden_.windows.size() - 1));
      result_.windows.windows = compare_windows(scene_.simulation, golden_, settings_.motion_tolerance,
                                                thread_count(options_), stop_, [this] { ++progress_.done; });
    }
    judge_motion(result_.windows, FindingKind::motion);
  }

  /// @param kind finding for a changed motion
  void judge_motion(Comparison& comparison, FindingKind kind) {
    for (const WindowResult& window : comparison.windows) {
      comparison.motion = std::max(comparison.motion, window.verdict);
    }
    if (comparison.motion == MotionVerdict::changed) add(kind);
  }

  /// @param kind finding for changed pictures
  void judge_pictures(Comparison& comparison, FindingKind kind) {
    for (const FrameResult& frame : comparison.frames) {
      if (frame.judged) comparison.picture = std::max(comparison.picture, frame.difference.verdict);
    }
    if (comparison.picture == PictureVerdict::changed) add(kind);
  }

  /// Recomputes the camera views by a run of the motion, if the golden views no longer hold.
  void place_camera() {
    if (same_camera(scene_.camera, golden_.camera) &&
        same_but_for_rounding(views_of_frames(scene_, golden_.size, golden_.frames), golden_.frames_views)) {
      return;
    }
    const auto recorded = record_motion(scene_, settings_, plan_of(golden_), stop_, progress_, recorded_);
    if (!recorded) return;
    for (GoldenFrame& frame : frames_) {
      const auto same = [&frame](const GoldenFrame& other) { return other.frame == frame.frame; };
      frame.view = std::find_if(recorded->frames.begin(), recorded->frames.end(), same)->view;
    }
  }

  void compare_golden_pictures() {
    place_camera();
    if (stop_.stop_requested()) return;
    DrawFrames drawing(scene_, golden_.size, options_.backend);
    result_.checked_on.renderer = drawing.renderer();
    result_.windows.frames = drawing.compare(frames_, result_.golden, settings_, stop_, progress_);
    judge_pictures(result_.windows, FindingKind::pictures);
  }

  void compare_end_to_end() {
    const auto recorded = record_motion(scene_, settings_, plan_of(golden_), stop_, progress_);
    if (!recorded) return;
    Comparison& whole = result_.end_to_end.emplace();
    whole.windows = compare_whole(scene_.simulation, golden_, *recorded, settings_.motion_tolerance);
    judge_motion(whole, FindingKind::whole_motion);
    DrawFrames drawing(scene_, golden_.size, options_.backend);
    std::vector<GoldenFrame> frames = chosen_frames(*recorded, options_.frames, result_.golden);
    for (std::size_t i = 0; i < frames.size(); ++i) frames[i].pixels = frames_[i].pixels;
    whole.frames = drawing.compare(frames, result_.golden, settings_, stop_, progress_);
    judge_pictures(whole, FindingKind::whole_pictures);
    find_first_bad(whole);
  }

  void find_first_bad(Comparison& comparison) const {
    const auto offer = [&](int frame) {
      comparison.first_bad_frame = std::min(comparison.first_bad_frame.value_or(frame), frame);
    };
    for (const WindowResult& window : comparison.windows) {
      if (window.verdict != MotionVerdict::changed) continue;
      const double begin = golden_.step * static_cast<double>(window.first_step);
      const auto after = std::find_if(frames_.begin(), frames_.end(), [&](const auto& f) { return f.time >= begin; });
      offer(after != frames_.end() ? after->frame : frames_.back().frame);
    }
    for (const FrameResult& frame : comparison.frames) {
      if (frame.judged && frame.difference.verdict == PictureVerdict::changed) offer(frame.frame);
    }
  }

  void add(FindingKind kind, std::string text = {}, Difference difference = {}) {
    result_.findings.push_back({.kind = kind, .text = std::move(text), .difference = std::move(difference)});
  }

  void conclude() {
    find_first_bad(result_.windows);
    const auto bad = [](const Comparison& c) {
      return c.motion == MotionVerdict::changed || c.picture == PictureVerdict::changed;
    };
    const bool changed = bad(result_.windows) || (result_.end_to_end && bad(*result_.end_to_end)) ||
                         !result_.film.empty() || result_.time;
    result_.verdict = changed ? SceneVerdict::changed : SceneVerdict::passed;
    if (changed && result_.windows.motion != MotionVerdict::changed) {
      if (result_.windows.picture == PictureVerdict::changed) {
        add(FindingKind::same_motion);
      } else if (!result_.end_to_end || !bad(*result_.end_to_end)) {
        add(FindingKind::same_windows);
      }
    }
    if (changed && !name_other_machine(result_.recorded_on, result_.checked_on).empty()) add(FindingKind::elsewhere);
    if (changed && result_.scene_changed) add(FindingKind::scene_changed);
    if (changed && overridden()) add(FindingKind::overrides, options_.overrides);
    if (!changed || options_.artefacts.empty()) return;
    if (!stop_.stop_requested()) {
      DifferenceAnimation made =
          difference_animation(scene_, golden_, result_, recorded_, options_.backend, options_.artefacts);
      result_.animation = std::move(made.film.gif);
      result_.stills = std::move(made.film.stills);
      result_.expected = std::move(made.expected);
      result_.actual = std::move(made.actual);
    }
    if (!stop_.stop_requested() && !overridden()) keep_candidate();
  }

  /// Returns the scene's own settings, without the command line's changes. Frames named when the golden was recorded
  /// stay, as far as the film has them.
  [[nodiscard]] CheckSettings settings_to_record() const {
    CheckSettings settings = scene_.check;
    if (!settings.frames.empty()) return settings;
    const int last = FilmExtent(scene_.video, scene_.simulation.step, scene_.step_count(), std::nullopt).frames.last;
    for (const GoldenFrame& frame : golden_.frames) {
      if (frame.why == named_frame && frame.frame <= last) settings.frames.push_back(frame.frame);
    }
    return settings;
  }

  /// Stores the recording that bless would make. If the motion diverges, there is nothing to accept.
  void keep_candidate() {
    std::optional<Recording> recording;
    try {
      recording = record_scene(scene_, settings_to_record(), options_.backend, stop_, progress_, recorded_);
    } catch (const DivergedError& diverged) {
      add(FindingKind::no_candidate, diverged.what());
    }
    if (!recording) return;
    result_.candidate =
        write_candidate(options_.artefacts, result_.name, scene_, recording->golden, recording->pictures);
  }

  LoadedScene scene_;
  const CheckSettings& settings_;
  PlayedMotion* recorded_;  // null: the scene is simulated
  const CheckOptions& options_;
  const std::stop_token& stop_;
  Progress& progress_;
  Golden golden_;
  std::vector<GoldenFrame> frames_;  // the compared frames of the golden
  SceneResult result_;
};

}  // namespace

SceneResult check_scene(const LoadedScene& scene, const std::string& name, const CheckSettings& settings,
                        const CheckOptions& options, const std::stop_token& stop, Progress& progress,
                        PlayedMotion* recorded) {
  const auto begin = std::chrono::steady_clock::now();
  require_texture(scene);
  if (recorded != nullptr) recorded->require_every_step(scene);
  SceneResult result = SceneCheck(scene, name, settings, recorded, options, stop, progress).run();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

SceneResult unjudged_scene(const LoadedScene& scene, const std::string& name, const CheckSettings& settings,
                           const Error& error) {
  SceneResult result = unchecked(scene, name, settings);
  result.verdict = SceneVerdict::error;
  result.error = error.kind();
  result.findings.push_back({FindingKind::error, error.what()});
  return result;
}

std::optional<Recording> record_scene(const LoadedScene& scene, const CheckSettings& settings, GlBackend backend,
                                      const std::stop_token& stop, Progress& progress, PlayedMotion* recorded) {
  if (recorded != nullptr) recorded->require_every_step(scene);
  const std::optional<RecordPlan> plan = plan_recording(scene, settings, stop, progress, recorded);
  if (!plan) return std::nullopt;
  std::optional<Golden> golden = record_motion(scene, settings, *plan, stop, progress, recorded);
  if (!golden) return std::nullopt;
  if (settings.time && scene.step_count() > 0 && recorded == nullptr) golden->time = measure_step_time(scene, 0, stop);
  DrawFrames drawing(scene, golden->size, backend);
  std::vector<Png> pictures = drawing.draw(golden->frames, stop, progress);
  if (stop.stop_requested()) return std::nullopt;
  golden->date = utc_now();
  golden->machine = this_machine(drawing.renderer());
  return Recording{std::move(*golden), std::move(pictures)};
}

std::optional<Blessing> bless_scene(const LoadedScene& scene, const CheckSettings& settings, GlBackend backend,
                                    const std::stop_token& stop, Progress& progress, PlayedMotion* recorded) {
  has_golden(golden_folder(scene.source.file));  // throws if another file is in its place
  require_texture(scene);
  const std::optional<Recording> recording = record_scene(scene, settings, backend, stop, progress, recorded);
  if (!recording) return std::nullopt;
  Blessing blessing{.folder = golden_folder(scene.source.file), .frames = static_cast<int>(recording->pictures.size())};
  blessing.size = write_golden(blessing.folder, recording->golden, recording->pictures);
  return blessing;
}

namespace {

constexpr double shortest_run = 0.03;  // duration of one measurement [s]
constexpr double calibration_time = 0.01;
constexpr std::size_t turns = 7;  // the result is their median
constexpr int attempts = 6;       // measurements before a time counts as too long

/// Returns the CPU time of this thread [s].
double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// A loop over springs between points, typical of a simulation's work. It must not change: goldens hold ratios to it.
class Calibration {
 public:
  Calibration() {
    for (std::size_t i = 0; i < points; ++i) {
      for (std::size_t k = 0; k < 3; ++k) x_[i][k] = std::sin(static_cast<double>(3 * i + k));
    }
  }

  /// Returns the time of a pass over all springs [s].
  double seconds() {
    const double begin = thread_seconds();
    double now = begin;
    std::int64_t passes = 0;
    for (; now - begin < calibration_time; now = thread_seconds(), ++passes) pass();
    return (now - begin) / static_cast<double>(passes);
  }

 private:
  static constexpr std::size_t points = 4000, reach = 37;

  void pass() {
    constexpr double stiffness = 1e-3, length = 1;
    for (std::size_t i = 0; i < points; ++i) {
      std::array<double, 3>&a = x_[i], &b = x_[(i + reach) % points];
      const std::array<double, 3> d{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
      const double norm = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) + length / 2;
      const double pull = stiffness * (norm - length) / norm;
      for (std::size_t k = 0; k < 3; ++k) {
        a[k] += pull * d[k];
        b[k] -= pull * d[k];
      }
    }
  }

  std::vector<std::array<double, 3>> x_ = std::vector<std::array<double, 3>>(points);
};

/// Runs the first steps; with `steps` = 0, until the time is measurable.
/// @returns their number
std::int64_t run(const Scene& scene, std::int64_t steps, const std::stop_token& stop) {
  const double begin = thread_seconds();
  Simulation simulation(scene.simulation);
  const std::int64_t all = scene.step_count();
  std::int64_t done = 0;
  while (done < all && !stop.stop_requested() && (steps > 0 ? done < steps : thread_seconds() - begin < shortest_run)) {
    simulation.step();
    ++done;
  }
  return done;
}

/// Returns the time of a run, repeated if short [s].
double run_seconds(const Scene& scene, std::int64_t steps, const std::stop_token& stop) {
  const double begin = thread_seconds();
  double taken = 0;
  int runs = 0;
  for (; taken < shortest_run && !stop.stop_requested(); ++runs) {
    run(scene, steps, stop);
    taken = thread_seconds() - begin;
  }
  return taken / std::max(1, runs);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::optional<GoldenTime> measure_step_time(const Scene& scene, std::int64_t steps, const std::stop_token& stop) {
  Calibration calibration;
  GoldenTime time;
  time.steps = run(scene, steps, stop);  // also warms the caches
  std::vector<double> ratios;
  double before = calibration.seconds();
  for (std::size_t turn = 0; turn < turns && time.steps > 0; ++turn) {
    const double seconds = run_seconds(scene, time.steps, stop);
    if (stop.stop_requested()) return std::nullopt;
    const double after = calibration.seconds();
    ratios.push_back(2 * seconds / (before + after));
    before = after;
  }
  if (stop.stop_requested()) return std::nullopt;
  time.ratio = ratios.empty() ? 0 : median(ratios);
  return time;
}

std::optional<SlowSteps> time_mismatch(const Scene& scene, const GoldenTime& golden, double limit,
                                       const std::stop_token& stop) {
  if (golden.steps == 0) return std::nullopt;
  double least = INFINITY;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const std::optional<GoldenTime> now = measure_step_time(scene, golden.steps, stop);
    if (!now) return std::nullopt;
    least = std::min(least, now->ratio / golden.ratio);
    if (least <= limit) return std::nullopt;
  }
  return SlowSteps{golden.steps, least};
}

}  // namespace drape
