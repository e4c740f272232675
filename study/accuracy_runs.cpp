#include "study/accuracy_runs.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numeric>

#include "core/files.hpp"
#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/scene/scene.hpp"
#include "study/accuracy_report.hpp"
#include "study/animation.hpp"
#include "study/motions.hpp"
#include "study/runs_file.hpp"

namespace drape {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double rounded_part = 1e-6;  // rounding tolerance, as a share of a step

/// Returns the scene's step that ends at a time; nothing for a time within a step.
std::optional<std::int64_t> moment_at(double time, double h) {
  const double steps = time / h;
  if (std::abs(steps - std::round(steps)) > rounded_part) return std::nullopt;
  return std::llround(steps);
}

}  // namespace

std::function<void(const Simulation&, const StepReport&)> MotionWatch::watch(MotionPoint& point,
                                                                             const StudyCase& study_case) {
  point.errors.assign(times_.size(), {unknown, unknown});
  Watched& watched = watched_.emplace_back();
  watched.point = &point;
  const Cloth& cloth = scene_.simulation.cloth;
  watched.before = {.x = cloth.positions, .v = cloth.velocities, .step = 0};
  return [this, &point, &watched, judged = study_case.steps](const Simulation& simulation, const StepReport& report) {
    const State& state = simulation.state();
    if (report.estimate && state.step <= judged) {
      point.substeps.push_back(static_cast<double>(report.substeps));
      point.estimates.push_back(*report.estimate);
      point.converged.push_back(report.converged ? 1 : 0);
      watched.steps.push_back({std::move(watched.before), state.x});
      watched.before = state;
    }
    const auto moment = moment_at(simulation.time(), scene_.simulation.step);
    const auto place = moment ? reference_->place(*moment) : std::nullopt;
    if (!place) return;
    for (std::size_t i = 0; i < times_.size(); ++i) {
      if (*moment == std::llround(times_[i] / scene_.simulation.step)) {
        point.errors[i] = distance(state.x, reference_->x[*place]);
      }
    }
    if (films_ == nullptr) return;
    if (const auto error = films_->error(*moment, state.x)) point.film_flip.push_back(*error);
    if (point.film_flip.size() != films_->count()) return;
    point.flip =
        std::accumulate(point.film_flip.begin(), point.film_flip.end(), 0.0) / static_cast<double>(films_->count());
  };
}

bool MotionWatch::find_local_errors(std::vector<MotionPoint>& points, std::vector<std::string>& notes,
                                    const std::stop_token& stop, Progress& progress) const {
  if (points.empty()) return true;
  progress.begin("taking single steps again", "cases", static_cast<std::int64_t>(points.size()));
  std::optional<LocalErrors> exact;
  try {
    exact.emplace(scene_.simulation);
  } catch (const UsageError& error) {
    notes.push_back(fmt::format("The true errors of steps are not known: {}", error.what()));
    return true;
  }
  for (MotionPoint& point : points) {
    const auto watched = std::ranges::find(watched_, &point, &Watched::point);
    for (const Step& step : watched->steps) {
      if (stop.stop_requested()) return false;
      const auto found = exact->of_step(step.before, step.after);
      point.local_errors.push_back(found ? found->error : unknown);
      point.local_unknown.push_back(found ? found->unknown : unknown);
    }
    ++progress.done;
  }
  return true;
}

namespace {

bool all_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// Returns true if a case has finite times, or a failure.
bool is_sound(const CaseRuns& runs) {
  const bool timed = !runs.microseconds.empty() || !runs.failure.empty();
  return timed && all_finite(runs.microseconds) && all_finite(runs.setup);
}

/// Returns true if the lists of a motion's steps have matching sizes; they may be empty.
bool is_sound(const MotionPoint& point, std::size_t times) {
  const std::size_t judged = point.local_errors.size();
  return is_sound(point.measured) && point.errors.size() == times && point.local_unknown.size() == judged &&
         point.estimates.size() >= judged && point.converged.size() >= judged;
}

}  // namespace

std::string unsound_in(const SceneAccuracy& scene) {
  const std::size_t times = scene.options.times.size();
  const bool moves = !scene.steps.empty() || !scene.asked.empty() || !scene.fixed.empty();
  if (times == 0) return "there are no times";
  if (!scene.points.empty() && scene.apart.size() != times) return "there are not as many 'apart' as 'times'";
  if (moves && (scene.step_gained.empty() || scene.step_gained.size() > times)) {
    return "there are not as many 'step_gained' as 'times'";
  }
  const auto bad_tolerance = [&](const TolerancePoint& p) { return !is_sound(p.measured) || p.motion.size() != times; };
  const auto bad_step = [](const StepPoint& p) { return !is_sound(p.measured); };
  const auto bad_motion = [&](const MotionPoint& p) { return !is_sound(p, times); };
  if (std::ranges::any_of(scene.points, bad_tolerance)) return "of a tolerance not everything is there";
  if (std::ranges::any_of(scene.steps, bad_step)) return "of a step not everything is there";
  if (std::ranges::any_of(scene.asked, bad_motion)) return "of an accuracy not everything is there";
  if (std::ranges::any_of(scene.fixed, bad_motion)) return "of a fixed step not everything is there";
  return {};
}

namespace {

constexpr std::size_t most_panels = 4;
constexpr double usual_tolerance = 1e-3;

/// Returns up to most_panels elements, evenly spread over a list and including its ends.
template <class T>
std::vector<T> spread(const std::vector<T>& all) {
  if (all.size() <= most_panels) return all;
  std::vector<T> some;
  for (std::size_t i = 0; i < most_panels; ++i) some.push_back(all[i * (all.size() - 1) / (most_panels - 1)]);
  return some;
}

std::string cost_label(double microseconds) {
  return fmt::format("{:.{}f} µs per step", microseconds, microseconds < 100 ? 1 : 0);
}

AnimationPanel panel(const TolerancePoint& p) {
  return {p.measured.study_case, fmt::format("{}, tolerance {:g}: {}", step_method_name(p.method), p.tolerance,
                                             cost_label(p.measured.time().median))};
}

AnimationPanel panel(const StepPoint& p) {
  return {p.measured.study_case,
          fmt::format("{}, h = {:g} s: {}", step_method_name(p.method), p.step, cost_label(p.measured.time().median))};
}

/// Returns the method whose tolerance or step varies: Liu13 if present, since its errors are the most visible.
StepMethod shown_method(const SceneAccuracy& accuracy) {
  const std::vector<StepMethod>& methods = accuracy.options.methods;
  const bool has_liu13 = std::find(methods.begin(), methods.end(), StepMethod(Method::liu13)) != methods.end();
  return has_liu13 ? StepMethod(Method::liu13) : methods.front();
}

double nearest_tolerance(const SceneAccuracy& accuracy) {
  const auto off = [](double tolerance) { return std::abs(std::log(tolerance / usual_tolerance)); };
  const std::vector<double>& all = accuracy.options.tolerances;
  return *std::min_element(all.begin(), all.end(), [&](double a, double b) { return off(a) < off(b); });
}

std::vector<AnimationPanel> panels_of(const SceneAccuracy& accuracy, AnimatedBy by) {
  std::vector<AnimationPanel> panels;
  if (by == AnimatedBy::steps) {
    for (const double step : spread(accuracy.options.steps)) {
      for (const StepPoint& p : accuracy.steps) {
        if (p.method == shown_method(accuracy) && p.step == step) panels.push_back(panel(p));
      }
    }
    return panels;
  }
  const std::vector<double> tolerances = by == AnimatedBy::tolerances
                                             ? spread(accuracy.options.tolerances)
                                             : std::vector<double>{nearest_tolerance(accuracy)};
  for (const double tolerance : tolerances) {
    for (const TolerancePoint& p : accuracy.points) {
      const bool shown = by == AnimatedBy::methods || p.method == shown_method(accuracy);
      if (shown && p.tolerance == tolerance) panels.push_back(panel(p));
    }
  }
  return panels;
}

}  // namespace

std::optional<StudyPicture> animate_accuracy(const SceneAccuracy& accuracy, AnimatedBy by,
                                             const std::filesystem::path& folder, GlBackend backend,
                                             const std::stop_token& stop, Progress& progress) {
  const std::vector<AnimationPanel> panels = panels_of(accuracy, by);
  if (panels.size() < 2) return std::nullopt;
  const Scene scene = load_scene(accuracy.scene, accuracy.options.overrides);
  SimulationSettings reference = scene.simulation;
  if (by == AnimatedBy::steps)
    reference.step = accuracy.options.steps.back() / static_cast<double>(reference_refinement);
  const std::string name = animated_by_names[static_cast<std::size_t>(by)];
  StudyPicture picture;
  picture.file = fmt::format("{}-by-{}.gif", accuracy.name, name);
  picture.caption = fmt::format(
      "{} with different {}. Vertices are coloured by their distance from the reference, computed {}. Above each "
      "panel: time per step, current error and flipped pairs of triangles.",
      accuracy.scene, name,
      by == AnimatedBy::steps ? fmt::format("with h = {:g} s", reference.step) : "by Newton's method down to rounding");
  picture.command = fmt::format("{} --animate {}", study_command(accuracy), name);
  auto animation = animate_errors(scene, to_rounding(reference, Method::implicit), panels, folder / picture.file,
                                  backend, stop, progress);
  if (!animation) return std::nullopt;
  picture.bytes = std::move(animation->film.gif);
  picture.stills = std::move(animation->film.stills);
  const AnimationPanel& worst = panels[animation->worst_panel];
  picture.motions = {{"the reference", {}, std::move(animation->reference)},
                     {worst.label + ", which ends furthest from the reference",
                      worst.study_case.film_command("motion.html"), std::move(animation->worst)}};
  return picture;
}

namespace {

constexpr int format = 2;
constexpr std::size_t most_bytes = std::size_t{1} << 31, most_picture_bytes = std::size_t{1} << 28;

// The fields, described once for both directions: Fields is a RunsWriter (with const data) or a RunsRecord.

template <class Fields, class Case>
void describe_case(Fields& f, Case& c) {
  f("label", c.study_case.label);
  f("scene", c.study_case.scene);
  f("overrides", c.study_case.overrides);
  f("steps", c.study_case.steps);
  f("watched_steps", c.study_case.watched_steps);
  f("step", c.step);
  f("iterations", c.iterations);
  f("capped_steps", c.capped);
  f("flipped_pairs", c.flipped_pairs);
  f("microseconds_per_step", c.microseconds);
  f("setup_microseconds", c.setup);
  f("failure", c.failure);
}

/// Stores distances as two lists.
void describe_distances(RunsWriter& f, const std::string& name, const std::vector<Distance>& distances) {
  std::vector<double> max, rms;
  for (const Distance& d : distances) {
    max.push_back(d.max);
    rms.push_back(d.rms);
  }
  f((name + "_max").c_str(), max);
  f((name + "_rms").c_str(), rms);
}
void describe_distances(RunsRecord& f, const std::string& name, std::vector<Distance>& distances) {
  std::vector<double> max, rms;
  f((name + "_max").c_str(), max);
  f((name + "_rms").c_str(), rms);
  if (max.size() != rms.size()) f.fail(f.line(), fmt::format("there are not as many {0}_max as {0}_rms", name));
  for (std::size_t i = 0; i < max.size(); ++i) distances.push_back({max[i], rms[i]});
}

template <class Fields, class Point>
requires std::same_as<std::remove_const_t<Point>, TolerancePoint>
void describe(Fields& f, Point& p) {
  describe_case(f, p.measured);
  f("solve_max", p.solve.max);
  f("solve_rms", p.solve.rms);
  f("solve_gradient", p.solve.gradient);
  describe_distances(f, "motion", p.motion);
}

template <class Fields, class Point>
requires std::same_as<std::remove_const_t<Point>, StepPoint>
void describe(Fields& f, Point& p) {
  describe_case(f, p.measured);
  f("error_max", p.error.max);
  f("error_rms", p.error.rms);
}

template <class Fields, class Point>
requires std::same_as<std::remove_const_t<Point>, MotionPoint>
void describe(Fields& f, Point& p) {
  describe_case(f, p.measured);
  describe_distances(f, "error", p.errors);
  f("film_flip", p.flip);
  f("frame_flip", p.film_flip);
  f("substeps", p.substeps);
  f("converged", p.converged);
  f("estimate", p.estimates);
  f("local_error", p.local_errors);
  f("local_error_unknown", p.local_unknown);
}

template <class Fields, class Scene>
requires std::same_as<std::remove_const_t<Scene>, SceneAccuracy>
void describe(Fields& f, Scene& s) {
  f("file", s.scene);
  f("digest", s.digest);
  f("step", s.step);
  f("tolerance_unit", s.tolerance_unit);
  f("tolerances", s.options.tolerances);
  f("steps", s.options.steps);
  f("times", s.options.times);
  f("accuracies", s.options.accuracies);
  f("overrides", s.options.overrides);
  f("runs", s.options.runs);
  f("part_solve", s.options.parts.solve);
  f("part_order", s.options.parts.order);
  f("patience", s.options.patience);
  f("part_asked", s.options.parts.asked);
  f("part_estimates", s.options.parts.estimates);
  f("part_films", s.options.parts.films);
  f("apart", s.apart);
  f("apart_by_step", s.apart_by_step);
  f("chaotic_from", s.chaotic_from);
  f("buckling_from", s.buckling_from);
  f("contact_from", s.contact_from);
  f("solve_apart", s.solve_apart);
  f("states", s.states);
  f("left_out", s.left_out);
  f("step_reference", s.step_reference);
  f("step_apart", s.step_apart);
  f("step_gained", s.step_gained);
  f("film_unknown", s.film_unknown);
  f("notes", s.notes);
}

double setting_of(const TolerancePoint& p) { return p.tolerance; }
double setting_of(const StepPoint& p) { return p.step; }
double setting_of(const MotionPoint& p) { return p.setting; }
void set(TolerancePoint& p, double setting) { p.tolerance = setting; }
void set(StepPoint& p, double setting) { p.step = setting; }
void set(MotionPoint& p, double setting) { p.setting = setting; }

template <class Point>
void write_points(RunsWriter& f, const std::string& scene, const char* kind, const std::vector<Point>& points) {
  for (const Point& p : points) {
    const std::string scheme = is_explicit(p.method.method) ? "" : scheme_name(p.method.scheme);
    f.begin({scene, kind, method_name(p.method.method), scheme, plain_number(setting_of(p))});
    describe(f, p);
  }
}

std::vector<std::string> names_of_methods(const std::vector<StepMethod>& methods) {
  std::vector<std::string> names;
  for (const StepMethod method : methods) names.push_back(step_method_name(method));
  return names;
}

StepMethod method_called(const RunsRecord& record, const std::string& name) {
  const std::vector<std::string> known = names_of_methods({step_methods.begin(), step_methods.end()});
  const auto found = std::ranges::find(known, name);
  if (found != known.end()) return step_methods.at(static_cast<std::size_t>(found - known.begin()));
  record.fail(record.line(), fmt::format("unknown method '{}'{}", name, did_you_mean(name, known, "the methods are")));
}

template <class Point>
void read_point(RunsRecord& record, std::vector<Point>& points) {
  const std::string& scheme = record.key.scheme;
  const bool named = !scheme.empty() && scheme != scheme_name({});
  Point& p = points.emplace_back();
  p.method = method_called(record, record.key.method + (named ? "-" + scheme : ""));
  double setting = 0;
  const char* const end = record.key.setting.data() + record.key.setting.size();
  if (std::from_chars(record.key.setting.data(), end, setting).ptr != end) {
    record.fail(record.line(), fmt::format("expected a number as the setting, found '{}'", record.key.setting));
  }
  set(p, setting);
  describe(record, p);
}

/// Reader of the records of a file, in order.
class StudyReader {
 public:
  explicit StudyReader(const std::filesystem::path& folder)
      : folder_(folder), file_((folder / runs_name).string()), motions_(read_motions(folder / motions_name)) {}

  void read(RunsRecord& record) {
    const std::string& kind = record.key.kind;
    if (kind == "study") {
      read_study(record);
    } else if (kind == "scene") {
      read_scene(record);
    } else if (kind == "picture") {
      read_picture(record);
    } else if (kind == "tolerance") {
      read_point(record, scene(record).points);
    } else if (kind == "step") {
      read_point(record, scene(record).steps);
    } else if (kind == "asked") {
      read_point(record, scene(record).asked);
    } else if (kind == "fixed") {
      read_point(record, scene(record).fixed);
    } else {
      const std::vector<std::string> known{"study", "scene", "picture", "tolerance", "step", "asked", "fixed"};
      record.fail(record.line(), fmt::format("unknown kind '{}'{}", kind, did_you_mean(kind, known, "the kinds are")));
    }
    record.done();
  }

  AccuracyStudy finish(const std::string& file) {
    if (study_.scenes.empty()) throw UsageError(fmt::format("{}:1: there is no scene in it", file));
    for (SceneAccuracy& one : study_.scenes) {
      const std::string problem = unsound_in(one);
      if (!problem.empty()) throw UsageError(fmt::format("{}: {}: {}", file, one.name, problem));
      find_orders(one.steps);
    }
    return std::move(study_);
  }

 private:
  void read_study(RunsRecord& record) {
    int found = 0;
    record("format", found);
    if (found != format) {
      record.fail(record.line(), fmt::format("expected runs of format {}, found {}: of another drape", format, found));
    }
    record("command", study_.command);
    std::optional<std::string> typed;
    record("typed_command", typed);
    study_.typed_command = typed.value_or("");
    record("seconds", study_.seconds);
    std::vector<std::string> names, values;
    record("measured_on", names);
    record("measured_on_value", values);
    for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i) {
      study_.provenance.emplace_back(names[i], values[i]);
    }
  }

  void read_scene(RunsRecord& record) {
    SceneAccuracy& s = study_.scenes.emplace_back();
    study_.pictures.emplace_back();
    s.name = name_in_folder(record.key.scene, place(record), "scene");
    describe(record, s);
    std::vector<std::string> methods;
    record("methods", methods);
    for (const std::string& method : methods) s.options.methods.push_back(method_called(record, method));
  }

  void read_picture(RunsRecord& record) {
    const auto number = static_cast<std::size_t>(&scene(record) - study_.scenes.data());
    StudyPicture& picture = study_.pictures[number].emplace_back();
    record("file", picture.file);
    record("caption", picture.caption);
    record("command", picture.command);
    name_in_folder(picture.file, place(record), "file");
    const std::filesystem::path file = folder_ / picture.file,
                                stills = std::filesystem::path(file).replace_extension(".png");
    picture.bytes = read_file(file, most_picture_bytes);
    if (std::filesystem::exists(stills)) picture.stills = read_file(stills, most_picture_bytes);
    for (const ShownMotion& one : motions_) {
      if (one.part == picture.file) picture.motions.push_back(one.motion);
    }
  }

  SceneAccuracy& scene(const RunsRecord& record) {
    const auto found = std::ranges::find(study_.scenes, record.key.scene, &SceneAccuracy::name);
    if (found != study_.scenes.end()) return *found;
    record.fail(record.line(), fmt::format("nothing was said yet about a scene '{}'", record.key.scene));
  }

  /// Returns "runs.csv:12", for messages.
  [[nodiscard]] std::string place(const RunsRecord& record) const { return fmt::format("{}:{}", file_, record.line()); }

  std::filesystem::path folder_;
  std::string file_;
  std::vector<ShownMotion> motions_;
  AccuracyStudy study_;
};

}  // namespace

std::string runs_csv(const AccuracyStudy& study) {
  RunsWriter f;
  f.begin({{}, "study", {}, {}, {}});
  f("format", format);
  f("command", study.command);
  if (!study.typed_command.empty()) f("typed_command", study.typed_command);
  f("seconds", study.seconds);
  std::vector<std::string> names, values;
  for (const auto& [name, value] : study.provenance) {
    names.push_back(name);
    values.push_back(value);
  }
  f("measured_on", names);
  f("measured_on_value", values);
  for (std::size_t i = 0; i < study.scenes.size(); ++i) {
    const SceneAccuracy& s = study.scenes[i];
    f.begin({s.name, "scene", {}, {}, {}});
    describe(f, s);
    f("methods", names_of_methods(s.options.methods));
    write_points(f, s.name, "tolerance", s.points);
    write_points(f, s.name, "step", s.steps);
    write_points(f, s.name, "asked", s.asked);
    write_points(f, s.name, "fixed", s.fixed);
    for (const StudyPicture& picture : study.pictures[i]) {
      f.begin({s.name, "picture", {}, {}, picture.file});
      f("file", picture.file);
      f("caption", picture.caption);
      f("command", picture.command);
    }
  }
  return f.finish();
}

void write_runs(const AccuracyStudy& study, const std::filesystem::path& folder) {
  std::vector<ShownMotion> motions;
  for (const std::vector<StudyPicture>& pictures : study.pictures) {
    for (const StudyPicture& picture : pictures) {
      for (const StudyMotion& motion : picture.motions) motions.push_back({picture.file, motion});
    }
  }
  if (!motions.empty()) write_file_atomically(folder / motions_name, motions_csv(motions));
  write_file_atomically(folder / runs_name, runs_csv(study));
}

AccuracyStudy read_runs(const std::filesystem::path& folder) {
  require_links_inside(folder);
  const std::filesystem::path file = folder / runs_name;
  std::vector<RunsRecord> records = parse_runs(read_text(file, most_bytes), shown(file));
  StudyReader reader(folder);
  for (RunsRecord& record : records) reader.read(record);
  return reader.finish(shown(file));
}

}  // namespace drape
