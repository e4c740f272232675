#include "study/validation.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/files.hpp"
#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/simulation.hpp"
#include "study/measure.hpp"
#include "study/validation_measures.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* case_format = "drape validation case 1";
constexpr const char* cases_folder = "scenes/validation";
constexpr std::size_t most_case_bytes = std::size_t{1} << 22;

/// A JSON object with access to members by name.
class CaseObject {
 public:
  CaseObject(const Json& json, std::string place) : json_(json), place_(std::move(place)) {
    if (!json.is_object()) fail("expected an object");
  }

  [[nodiscard]] std::string text(const char* key) const { return of<std::string>(key, "a text"); }
  [[nodiscard]] std::string text_or(const char* key, std::string otherwise) const {
    return has(key) ? text(key) : std::move(otherwise);
  }
  [[nodiscard]] double number(const char* key) const {
    if (!at(key).is_number()) fail(fmt::format("expected a number as '{}'", key));
    return at(key).get<double>();
  }
  [[nodiscard]] std::vector<std::string> texts(const char* key) const {
    return has(key) ? of<std::vector<std::string>>(key, "a list of texts") : std::vector<std::string>{};
  }
  [[nodiscard]] std::map<std::string, double> numbers(const char* key) const {
    return has(key) ? of<std::map<std::string, double>>(key, "numbers by name") : std::map<std::string, double>{};
  }
  [[nodiscard]] bool has(const char* key) const { return json_.contains(key); }
  [[nodiscard]] std::vector<CaseObject> objects(const char* key) const {
    std::vector<CaseObject> list;
    if (!has(key)) return list;
    if (!at(key).is_array()) fail(fmt::format("expected a list as '{}'", key));
    for (const Json& one : at(key)) list.emplace_back(one, place_);
    return list;
  }
  [[nodiscard]] CaseObject object(const char* key) const { return {at(key), place_}; }
  [[noreturn]] void fail(const std::string& sentence) const {
    throw UsageError(fmt::format("{}: {}", place_, sentence));
  }

 private:
  [[nodiscard]] const Json& at(const char* key) const {
    if (!has(key)) fail(fmt::format("expected a member '{}'", key));
    return json_.at(key);
  }
  template <class T>
  [[nodiscard]] T of(const char* key, const char* kind) const {
    try {
      return at(key).get<T>();
    } catch (const Json::exception&) {
      fail(fmt::format("expected {} as '{}'", kind, key));
    }
  }

  const Json& json_;
  std::string place_;
};

KnownAnswer read_answer(const CaseObject& from, const ValidationCase& of) {
  KnownAnswer answer;
  answer.name = from.text("name");
  answer.curve = from.text_or("curve", answer.name);
  answer.x = from.number("x");
  answer.value = from.number("value");
  answer.tolerance = from.number("tolerance");
  if (!(answer.tolerance > 0)) from.fail("expected a tolerance above 0");
  const auto is_curve = [&](const ValidationCurve& curve) { return curve.name == answer.curve; };
  if (std::ranges::none_of(of.curves, is_curve)) from.fail(fmt::format("there is no curve '{}'", answer.curve));
  return answer;
}

ValidationProblem read_problem(const CaseObject& from, const ValidationCase& of) {
  ValidationProblem problem;
  problem.name = from.text("name");
  problem.overrides = from.texts("set");
  problem.given = from.numbers("given");
  problem.given.insert(of.given.begin(), of.given.end());
  for (const CaseObject& answer : from.objects("answers")) problem.answers.push_back(read_answer(answer, of));
  if (problem.answers.empty()) from.fail(fmt::format("problem '{}' has no answers", problem.name));
  return problem;
}

ValidationFactor read_factor(const CaseObject& from, const ValidationCase& of) {
  ValidationFactor factor{from.text("factor"), of.problem(from.text("problem")).name, {}};
  for (const CaseObject& one : from.objects("runs")) {
    const std::string name = one.text("name");
    factor.variants.push_back({name, factor.factor == "method" ? name : "", one.texts("set")});
  }
  return factor;
}

std::vector<std::string> known_cases(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (fs::exists(entry.path() / "case.json", error)) names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace

const ValidationProblem& ValidationCase::problem(const std::string& called) const {
  std::vector<std::string> names;
  for (const ValidationProblem& one : problems) {
    if (one.name == called) return one;
    names.push_back(one.name);
  }
  throw UsageError(
      fmt::format("{} has no problem '{}'{}", name, called, did_you_mean(called, names, "the problems are")));
}

ValidationCase read_validation_case(const fs::path& file, const std::string& scene_folder) {
  const Json json = Json::parse(read_text(file, most_case_bytes), nullptr, false, true);
  if (json.is_discarded()) throw UsageError(fmt::format("{}: expected JSON", shown(file)));
  const CaseObject from(json, shown(file));
  if (from.text("format") != case_format) from.fail(fmt::format("expected the format '{}'", case_format));
  ValidationCase result;
  result.name = file.parent_path().filename().string();
  result.title = from.text("title");
  result.question = from.text("question");
  result.theory = from.text("theory");
  result.source = from.text("source");
  result.mesh = from.text("mesh");
  result.scene = scene_folder + "/" + name_in_folder(from.text("scene"), shown(file), "scene");
  result.measure = from.text("measure");
  result.x_title = from.text("x");
  result.given = from.numbers("given");
  if (from.has("rest")) {
    result.only_end = true;
    result.rest_speed = from.object("rest").number("speed");
    result.rest_after = from.object("rest").number("after");
  }
  for (const CaseObject& one : from.objects("curves")) {
    result.curves.push_back({one.text("name"), one.text("title"), one.text("how")});
  }
  if (result.curves.empty()) from.fail("expected at least one curve");
  result.default_overrides = from.texts("default");
  for (const CaseObject& one : from.objects("problems")) result.problems.push_back(read_problem(one, result));
  if (result.problems.empty()) from.fail("expected at least one problem");
  result.quick = from.texts("quick");
  for (const std::string& name : result.quick) static_cast<void>(result.problem(name));
  if (from.has("quick_set")) result.quick_overrides = from.texts("quick_set");
  for (const CaseObject& one : from.objects("vary")) result.factors.push_back(read_factor(one, result));
  return result;
}

std::vector<ValidationCase> validation_cases(const std::vector<std::string>& names) {
  const fs::path folder = data_folder() / cases_folder;
  const std::vector<std::string> known = known_cases(folder);
  if (known.empty()) throw UsageError(fmt::format("{}: there is no case in it", shown(folder)));
  std::vector<ValidationCase> cases;
  for (const std::string& name : names.empty() ? known : names) {
    if (std::ranges::find(known, name) == known.end()) {
      throw UsageError(fmt::format("unknown case '{}'{}", name, did_you_mean(name, known, "the cases are")));
    }
    const auto same = [&](const ValidationCase& one) { return one.name == name; };
    if (std::ranges::any_of(cases, same)) continue;
    cases.push_back(read_validation_case(folder / name / "case.json", fmt::format("{}/{}", cases_folder, name)));
  }
  return cases;
}

namespace {

StudyCase study_case(const ValidationCase& of, const ValidationProblem& problem,
                     const std::vector<std::string>& overrides, const std::string& label) {
  StudyCase study_case;
  study_case.label = label;
  study_case.scene = of.scene;
  study_case.overrides = problem.overrides;
  study_case.overrides.insert(study_case.overrides.end(), overrides.begin(), overrides.end());
  study_case.steps = study_case.load().step_count();
  return study_case;
}

void plan_case(const ValidationCase& of, const ValidationOptions& options, std::vector<ValidationRun>& runs) {
  const auto add = [&](const ValidationProblem& problem, const std::string& factor, const std::string& setting,
                       const std::vector<std::string>& overrides) {
    ValidationRun& run = runs.emplace_back();
    run.name = of.name;
    run.problem = problem.name;
    run.factor = factor;
    run.setting = setting;
    run.study_case = study_case(of, problem, overrides, setting);
  };
  const auto wanted = [&](const ValidationProblem& problem) {
    return !options.quick || std::ranges::find(of.quick, problem.name) != of.quick.end();
  };
  const std::vector<std::string> none;
  for (const ValidationProblem& problem : of.problems) {
    if (wanted(problem)) add(problem, scene_factor, scene_factor, options.quick ? of.quick_overrides : none);
  }
  if (options.quick) return;
  for (const ValidationProblem& problem : of.problems)
    add(problem, default_factor, default_factor, of.default_overrides);
  for (const ValidationFactor& factor : of.factors) {
    for (const ValidationVariant& variant : factor.variants) {
      const bool asked = variant.method.empty() || options.methods.empty() ||
                         std::ranges::find(options.methods, variant.method) != options.methods.end();
      if (asked) add(of.problem(factor.problem), factor.factor, variant.name, variant.overrides);
    }
  }
}

/// A simulation of a case that stores the states for its measure.
class ValidationMotion {
 public:
  ValidationMotion(const ValidationCase& of, const Scene& scene) : of_(of), simulation_(scene.simulation) {
    motion_.cloth = scene.simulation.cloth;
    if (!of.only_end) keep();
  }

  /// Takes a step. @returns true after the last step, when the whole cloth is at rest
  bool step(ValidationRun& run) {
    const StepReport report = simulation_.step();
    run.capped += report.converged ? 0 : 1;
    if (!of_.only_end) keep();
    if (!of_.rest_speed) return false;
    run.rest_speed = std::sqrt(simulation_.state().v.rowwise().squaredNorm().maxCoeff());
    slow_ = run.rest_speed < *of_.rest_speed ? slow_ + 1 : 0;
    return slow_ >= 3 && simulation_.time() >= of_.rest_after;
  }

  [[nodiscard]] const Simulation& simulation() const { return simulation_; }

  ObservedMotion finish() {
    if (of_.only_end) keep();
    return std::move(motion_);
  }

 private:
  void keep() {
    motion_.times.push_back(simulation_.time());
    motion_.positions.push_back(simulation_.state().x);
    motion_.velocities.push_back(simulation_.state().v);
    motion_.elastic.push_back(simulation_.energies().elastic);
  }

  const ValidationCase& of_;
  Simulation simulation_;
  ObservedMotion motion_;
  int slow_ = 0;  // consecutive steps below the speed limit
};

double mean_spring_length(const Cloth& cloth) {
  double sum = 0;
  for (const Spring& spring : cloth.springs) sum += spring.rest_length;
  return cloth.springs.empty() ? 0 : sum / static_cast<double>(cloth.springs.size());
}

/// Returns true for the run whose motion the report shows: the first problem of --quick, with the original scene.
bool is_shown(const ValidationCase& of, const ValidationRun& run) {
  return run.factor == scene_factor && run.problem == (of.quick.empty() ? of.problems.front().name : of.quick.front());
}

/// @returns false if stopped
bool measure_run(const ValidationCase& of, ValidationRun& run, double patience, const std::stop_token& stop) {
  const double begin = thread_seconds();
  try {
    const Scene scene = run.study_case.load();
    run.step = scene.simulation.step;
    run.cell = mean_spring_length(scene.simulation.cloth);
    run.vertices = scene.simulation.cloth.vertex_count();
    ValidationMotion motion(of, scene);
    std::optional<StudyMotionRecorder> recorder;
    if (is_shown(of, run)) recorder.emplace(scene);
    for (std::int64_t step = 0; step < run.study_case.steps; ++step) {
      if (stop.stop_requested()) return false;
      if (recorder) recorder->add(motion.simulation());
      if (motion.step(run)) break;
      if (thread_seconds() - begin > patience) {
        throw UsageError(fmt::format("given up after {:g} s of computing", patience));
      }
    }
    run.seconds = thread_seconds() - begin;
    if (recorder) {
      recorder->add(motion.simulation());
      run.played = recorder->finish();
    }
    for (const auto& [name, value] : measure_motion(of.measure, motion.finish(), of.problem(run.problem).given)) {
      run.names.push_back(name);
      run.values.push_back(value);
    }
  } catch (const Error& error) {
    run.failure = error.what();
    run.seconds = thread_seconds() - begin;
  }
  run.measured = true;
  return true;
}

void require_methods(const std::vector<std::string>& methods) {
  std::vector<std::string> known;
  for (const StepMethod method : step_methods) known.push_back(step_method_name(method));
  for (const std::string& name : methods) {
    if (std::ranges::find(known, name) != known.end()) continue;
    throw UsageError(fmt::format("--methods: unknown '{}'{}", name, did_you_mean(name, known, "the methods are")));
  }
}

}  // namespace

std::optional<double> ValidationRun::value(const std::string& quantity) const {
  const auto found = std::ranges::find(names, quantity);
  if (found == names.end()) return std::nullopt;
  return values[static_cast<std::size_t>(found - names.begin())];
}

const ValidationRun* ValidationStudy::run(const std::string& name, const std::string& problem,
                                          const std::string& factor) const {
  const auto found = std::ranges::find_if(runs, [&](const ValidationRun& one) {
    return one.measured && one.name == name && one.problem == problem && one.factor == factor;
  });
  return found == runs.end() ? nullptr : &*found;
}

namespace {

/// Reduces the runs to those of a shard, each with its position in the full plan.
void keep_shard(const Shard& shard, std::vector<ValidationRun>& runs) {
  std::vector<double> costs;
  for (const ValidationRun& run : runs) {
    const Scene scene = run.study_case.load();
    costs.push_back(static_cast<double>(scene.step_count()) * scene.simulation.cloth.vertex_count());
  }
  std::vector<ValidationRun> kept;
  for (const std::size_t place : runs_of_shard(costs, shard)) {
    kept.push_back(std::move(runs[place]));
    kept.back().place = static_cast<std::int64_t>(place);
  }
  runs = std::move(kept);
}

}  // namespace

std::size_t ValidationStudy::missing() const {
  const auto measured = static_cast<std::size_t>(std::ranges::count_if(runs, &ValidationRun::measured));
  return std::max(planned, measured) - measured;
}

ValidationStudy plan_validation(const ValidationOptions& options) {
  require_methods(options.methods);
  ValidationStudy study;
  study.cases = validation_cases(options.cases);
  for (const ValidationCase& one : study.cases) plan_case(one, options, study.runs);
  study.shard = options.shard;
  if (!options.shard.whole()) keep_shard(options.shard, study.runs);
  study.planned = study.runs.size();
  return study;
}

bool measure_validation(ValidationStudy& study, const ValidationOptions& options, const std::stop_token& stop,
                        Progress& progress, const std::function<void()>& save) {
  progress.begin("measuring", "runs", static_cast<std::int64_t>(study.runs.size()));
  std::atomic<std::size_t> next = 0;
  std::mutex saving;
  const auto work = [&] {
    for (std::size_t i = next++; i < study.runs.size(); i = next++) {
      ValidationRun run;
      {
        const std::scoped_lock lock(saving);
        run = study.runs[i];
      }
      const auto of = std::ranges::find(study.cases, run.name, &ValidationCase::name);
      if (!run.measured && !measure_run(*of, run, options.patience, stop)) return;
      const std::scoped_lock lock(saving);
      const bool is_new = !study.runs[i].measured;
      study.runs[i] = std::move(run);
      ++progress.done;
      if (is_new) save();
    }
  };
  {
    std::vector<std::jthread> others;
    for (int job = 1; job < options.jobs; ++job) others.emplace_back(work);
    work();
  }
  return !stop.stop_requested();
}

double in_tolerances(const KnownAnswer& answer, double value) {
  return std::abs(value - answer.value) / answer.tolerance;
}

}  // namespace drape
