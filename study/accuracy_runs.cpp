#include "study/accuracy_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

#include "core/names_in_folders.hpp"
#include "core/nearest.hpp"
#include "core/read_file.hpp"
#include "core/text.hpp"
#include "scene/method_names.hpp"
#include "study/accuracy_soundness.hpp"
#include "study/runs_file.hpp"

namespace drape {
namespace {

constexpr int format = 2;
constexpr std::size_t most_bytes = std::size_t{1} << 31, most_picture_bytes = std::size_t{1} << 28;

// The fields, described once for both directions: Fields is a RunsWriter (with const data) or a RunsRecord.

template <class Fields, class Case>
void describe_case(Fields& f, Case& c) {
  f("label", c.what.label);
  f("scene", c.what.scene);
  f("overrides", c.what.overrides);
  f("steps", c.what.steps);
  f("watched_steps", c.what.watched_steps);
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
  const bool second = record.key.scheme == scheme_name(TimeScheme::sdirk2);
  Point& p = points.emplace_back();
  p.method = method_called(record, record.key.method + (second ? "-sdirk2" : ""));
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
  explicit StudyReader(const std::filesystem::path& folder) : folder_(folder), file_((folder / runs_name).string()) {}

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
  AccuracyStudy study_;
};

}  // namespace

std::string runs_csv(const AccuracyStudy& study) {
  RunsWriter f;
  f.begin({{}, "study", {}, {}, {}});
  f("format", format);
  f("command", study.command);
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

AccuracyStudy read_runs(const std::filesystem::path& folder) {
  require_links_inside(folder);
  const std::filesystem::path file = folder / runs_name;
  std::vector<RunsRecord> records = parse_runs(read_text(file, most_bytes), shown(file));
  StudyReader reader(folder);
  for (RunsRecord& record : records) reader.read(record);
  return reader.finish(shown(file));
}

}  // namespace drape
