#include "study/accuracy.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/text.hpp"
#include "drape/scene/scene.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"
#include "study/accuracy_runs.hpp"

namespace drape {
namespace {

constexpr std::int64_t states = 12;         // states of the reference in which single steps are solved
constexpr double error_of_reference = 0.1;  // largest error of the reference, as a share of the smallest accuracy

void sort_without_repetition(std::vector<std::int64_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// The running study of one scene.
class SceneStudy {
 public:
  SceneStudy(const std::string& name, const std::string& file, const AccuracyOptions& asked)
      : scene_(load_scene(file, asked.overrides)) {
    scene_.simulation.integrator.scheme = TimeScheme::backward_euler;  // for the steps whose solves are compared
    result_.name = name;
    result_.scene = file;
    result_.options = complete(asked, scene_);
    result_.step = scene_.simulation.step;
    result_.tolerance_unit = scene_.simulation.integrator.stop == StoppingRule::gradient ? "N" : "m";
    if (asked.methods.empty() || asked.of_several_scenes)
      leave_out_methods(scene_, file, result_.options, result_.notes);
    cases_ = accuracy_cases(scene_, file, result_.options, result_.notes);
  }

  /// @throws UsageError if a case or a reference cannot be run
  void check() const {
    for (const StudyCase& one : cases_.easiest) static_cast<void>(one.load());
    for (const ToleranceCase& one : cases_.tolerances) static_cast<void>(one.study_case.load());
    for (const auto* list : {&cases_.steps, &cases_.asked, &cases_.fixed}) {
      for (const StepCase& one : *list) static_cast<void>(one.study_case.load());
    }
    for (const Method method : {Method::implicit, Method::quasi_newton}) {
      const Simulation reference(to_rounding(scene_.simulation, method));
    }
  }

  std::optional<SceneAccuracy> run(const std::stop_token& stop, Progress& progress) {
    if (!find_references(stop, progress)) return std::nullopt;
    std::optional<FilmJudge> films;
    if (result_.options.parts.films) films.emplace(scene_, film_steps_, *small_steps_, result_.options.backend);
    if (films) result_.film_unknown = films->unknown();
    motions_.emplace(scene_, result_.options.times, small_steps_ ? &*small_steps_ : nullptr, films ? &*films : nullptr);
    if (!measure_cases(stop, progress) || !find_solve_errors(stop, progress)) return std::nullopt;
    if (result_.options.parts.estimates && !motions_->find_local_errors(result_.asked, result_.notes, stop, progress)) {
      return std::nullopt;
    }
    find_orders(result_.steps);
    return std::move(result_);
  }

 private:
  bool find_references(const std::stop_token& stop, Progress& progress) {
    return find_same_steps(stop, progress) && find_small_steps(stop, progress);
  }

  /// Computes the reference with the scene's own steps, and the times of contact and buckling.
  bool find_same_steps(const std::stop_token& stop, Progress& progress) {
    const bool judged = result_.options.parts.estimates && !cases_.asked.empty();
    if (!result_.options.parts.solve && !judged) return true;
    const std::vector<double>& times = result_.options.times;
    const std::int64_t last = steps_until(times.back(), result_.step);
    const std::int64_t whole = result_.options.parts.solve ? scene_.step_count() : last;
    std::vector<std::int64_t> keep;
    for (std::int64_t i = 0; i < states; ++i) keep.push_back(i * last / states);
    for (const double time : times) keep.push_back(steps_until(time, result_.step));
    sort_without_repetition(keep);
    reference_ = run_reference(scene_.simulation, whole, keep, stop, progress);
    if (!reference_) return false;
    result_.apart_by_step = reference_->apart;
    for (const double time : times) result_.apart.push_back(reference_->apart_after(steps_until(time, result_.step)));
    const auto seconds = [this](const std::optional<std::int64_t>& step) {
      return step ? std::optional(static_cast<double>(*step) * result_.step) : std::nullopt;
    };
    result_.chaotic_from = seconds(reference_->first_beyond(smallest_error));
    result_.buckling_from = seconds(reference_->first_beyond(largest_rounding));
    if (judged) {
      const std::int64_t first = steps_until(times.front(), result_.step);
      result_.contact_from = seconds(first_contact(scene_.simulation, first, largest_rounding, stop));
    }
    return true;
  }

  bool find_small_steps(const std::stop_token& stop, Progress& progress) {
    if (cases_.steps.empty() && cases_.asked.empty() && cases_.fixed.empty()) return true;
    const AccuracyOptions& options = result_.options;
    std::vector<std::int64_t> moments;
    for (const double time : options.times) moments.push_back(steps_until(time, result_.step));
    if (!options.parts.asked) moments.resize(1);
    if (options.parts.films) {
      film_steps_ = film_steps(scene_, moments.back());
      moments.insert(moments.end(), film_steps_.begin(), film_steps_.end());
    }
    sort_without_repetition(moments);
    const auto parts = static_cast<std::int64_t>(std::ceil(result_.step / options.steps.back() - 1e-9));
    const double wanted = options.parts.asked ? error_of_reference * options.accuracies.back() : HUGE_VAL;
    small_steps_ = extrapolate_steps(scene_.simulation, moments,
                                     reference_refinement * std::max<std::int64_t>(1, parts), wanted, stop, progress);
    if (!small_steps_) return false;
    result_.step_reference = small_steps_->step;
    for (const double time : options.times) {
      const auto place = small_steps_->place(steps_until(time, result_.step));
      if (place) result_.step_gained.push_back(small_steps_->gained(*place));
    }
    result_.step_apart = small_steps_->apart;
    return true;
  }

  [[nodiscard]] const State& reference_after(std::int64_t step) const {
    return *std::find_if(reference_->states.begin(), reference_->states.end(),
                         [step](const State& state) { return state.step == step; });
  }

  void look_at(TolerancePoint& point, const State& state) const {
    for (const double time : result_.options.times) {
      if (state.step != steps_until(time, result_.step)) continue;
      point.motion.push_back(distance(state.x, reference_after(state.step).x));
    }
  }

  void look_at(StepPoint& point, const State& state, std::int64_t last) const {
    const auto place = small_steps_->place(steps_until(result_.options.times.front(), result_.step));
    if (state.step == last) point.error = distance(state.x, small_steps_->x[place.value()]);
  }

  bool measure_cases(const std::stop_token& stop, Progress& progress) {
    std::vector<StudyCase> all;
    std::vector<std::function<void(const Simulation&, const StepReport&)>> watches;
    std::vector<CaseRuns*> kept;
    const auto add = [&](const StudyCase& study_case, CaseRuns& runs, auto watch) {
      all.push_back(study_case);
      kept.push_back(&runs);
      watches.emplace_back(std::move(watch));
    };
    result_.points.resize(cases_.tolerances.size());
    for (std::size_t i = 0; i < result_.points.size(); ++i) {
      TolerancePoint& point = result_.points[i];
      point.method = cases_.tolerances[i].method;
      point.tolerance = cases_.tolerances[i].tolerance;
      add(cases_.tolerances[i].study_case, point.measured,
          [this, &point](const Simulation& now, const StepReport&) { look_at(point, now.state()); });
    }
    result_.steps.resize(cases_.steps.size());
    for (std::size_t i = 0; i < result_.steps.size(); ++i) {
      StepPoint& point = result_.steps[i];
      point.method = cases_.steps[i].method;
      point.step = cases_.steps[i].setting;
      point.error = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
      add(cases_.steps[i].study_case, point.measured,
          [this, &point, last = cases_.steps[i].study_case.steps](const Simulation& now, const StepReport&) {
            look_at(point, now.state(), last);
          });
    }
    for (const auto& [from, points] :
         {std::pair(&cases_.asked, &result_.asked), std::pair(&cases_.fixed, &result_.fixed)}) {
      points->resize(from->size());
      for (std::size_t i = 0; i < from->size(); ++i) {
        MotionPoint& point = (*points)[i];
        point.method = (*from)[i].method;
        point.setting = (*from)[i].setting;
        add((*from)[i].study_case, point.measured, motions_->watch(point, (*from)[i].study_case));
      }
    }
    const CaseWatch watch = [&](std::size_t number, const Simulation& simulation, const StepReport& report) {
      watches[number](simulation, report);
    };
    const std::vector<Measured> measured = measure(all, result_.options.runs, stop, progress, watch);
    if (measured.empty()) return all.empty();
    for (std::size_t i = 0; i < all.size(); ++i) *kept[i] = CaseRuns(measured[i]);
    return true;
  }

  bool find_solve_errors(const std::stop_token& stop, Progress& progress) {
    if (result_.points.empty()) return true;
    progress.begin("solving single steps", "cases", static_cast<std::int64_t>(result_.points.size()));
    const ExactSteps exact(scene_.simulation, reference_->states, smallest_error);
    result_.states = static_cast<std::int64_t>(exact.count());
    result_.left_out = static_cast<std::int64_t>(exact.left_out());
    result_.solve_apart = exact.apart();
    for (TolerancePoint& point : result_.points) {
      if (stop.stop_requested()) return false;
      point.solve = exact.error(point.measured.study_case.load().simulation.integrator);
      ++progress.done;
    }
    return true;
  }

  LoadedScene scene_;
  SceneAccuracy result_;
  AccuracyCases cases_;
  std::vector<std::int64_t> film_steps_;
  std::optional<ReferenceMotion> reference_;
  std::optional<StepReference> small_steps_;
  std::optional<MotionWatch> motions_;
};

}  // namespace

CaseRuns::CaseRuns(const Measured& measured)
    : study_case(measured.study_case),
      step(measured.step),
      iterations(measured.mean_iterations()),
      capped(measured.capped),
      flipped_pairs(measured.flipped_pairs),
      microseconds(measured.microseconds),
      setup(measured.setup),
      failure(measured.failure) {}

MedianInterval CaseRuns::cost() const {
  std::vector<double> whole = microseconds;
  for (std::size_t i = 0; i < std::min(whole.size(), setup.size()); ++i) {
    whole[i] += setup[i] / static_cast<double>(study_case.steps);
  }
  return median_interval(std::move(whole)).times(1e-3 / step);
}

void find_orders(std::vector<StepPoint>& steps) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    StepPoint& point = steps[i];
    const bool first = i == 0 || steps[i - 1].method != point.method;
    const StepPoint& larger = steps[first ? i : i - 1];
    point.order = first ? std::numeric_limits<double>::quiet_NaN()
                        : std::log(larger.error.max / point.error.max) / std::log(larger.step / point.step);
  }
}

void check_accuracy(const std::string& file, const AccuracyOptions& options) { SceneStudy({}, file, options).check(); }

std::optional<SceneAccuracy> study_accuracy(const std::string& name, const std::string& file,
                                            const AccuracyOptions& options, const std::stop_token& stop,
                                            Progress& progress) {
  return SceneStudy(name, file, options).run(stop, progress);
}

namespace {

constexpr double shortest_part = 1e-9;           // rounding tolerance, as a share of a step
constexpr std::int64_t most_small_steps = 2000;  // limit for the smallest default step
constexpr int most_halvings = 6;

std::vector<double> default_steps(double h, double time) {
  std::vector<double> steps;
  for (int i = 0; i <= most_halvings; ++i, h /= 2) {
    if (i > 2 && steps_until(time, h) > most_small_steps) break;
    steps.push_back(h);
  }
  return steps;
}

/// Sorts in descending order and removes duplicates.
void tidy(std::vector<double>& values) {
  std::sort(values.rbegin(), values.rend());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

std::string names_of(const AccuracyParts& parts) {
  std::string names;
  for (const auto& [name, part] : accuracy_parts) {
    if (parts.*part) names.append(names.empty() ? "" : ",").append(name);
  }
  return names;
}

AccuracyOptions complete(AccuracyOptions options, const LoadedScene& scene) {
  const double h = scene.simulation.step, duration = scene.duration;
  if (options.methods.empty()) {
    options.methods.assign(step_methods.begin(), step_methods.end());
    const auto first = [](StepMethod how) { return !is_explicit(how.method) && how.scheme == TimeScheme{}; };
    std::stable_partition(options.methods.begin(), options.methods.end(), first);
  }
  if (options.tolerances.empty()) options.tolerances = {1, 0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
  if (options.accuracies.empty()) options.accuracies = {1e-2, 1e-3, 1e-4};
  if (options.times.empty()) options.times = {duration / 20, duration / 8, duration / 4};
  for (double& time : options.times) {
    const std::int64_t steps = steps_until(time, h);
    if (steps < 1 || steps > scene.step_count()) {
      throw UsageError(fmt::format("--times: {:g} s is beyond the motion of {}, which lasts {:g} s", time,
                                   shown(scene.source.file), duration));
    }
    time = static_cast<double>(steps) * h;
  }
  std::sort(options.times.begin(), options.times.end());
  options.times.erase(std::unique(options.times.begin(), options.times.end()), options.times.end());
  if (options.steps.empty()) options.steps = default_steps(h, options.times.front());
  tidy(options.steps);
  tidy(options.tolerances);
  tidy(options.accuracies);
  for (const double step : options.steps) {
    const double count = options.times.front() / step;
    if (!(count >= 1 - shortest_part) || std::abs(count - std::round(count)) > shortest_part * count) {
      throw UsageError(fmt::format("--steps: {:g} s does not divide {:g} s, the first of --times, in {}", step,
                                   options.times.front(), shown(scene.source.file)));
    }
  }
  return options;
}

namespace {

// Tolerance of the cases that differ in their step: small enough to make the solve's error negligible.
constexpr double small_tolerance = 1e-9;

/// Returns the case of a scene with its own method and the study's overrides.
StudyCase base_case(const std::string& file, const AccuracyOptions& options, std::string label) {
  StudyCase study_case;
  study_case.label = std::move(label);
  study_case.scene = file;
  study_case.folder = std::filesystem::current_path();
  study_case.overrides = options.overrides;
  return study_case;
}

StudyCase make_case(const std::string& file, const AccuracyOptions& options, StepMethod method, std::string label) {
  StudyCase study_case = base_case(file, options, std::move(label));
  study_case.overrides.push_back("integrator.method=" + method_name(method.method));
  if (!is_explicit(method.method)) study_case.overrides.push_back("integrator.scheme=" + scheme_name(method.scheme));
  return study_case;
}

void add_tolerance(StudyCase& study_case, double tolerance) {
  study_case.overrides.push_back("integrator.tolerance=" + plain_number(tolerance));
  study_case.overrides.push_back(fmt::format("integrator.max_iterations={}", most_study_iterations));
}

/// Returns true if a method is stable with this step length.
bool is_stable(SimulationSettings settings, StepMethod method, double step) {
  settings.integrator.method = method.method;
  settings.integrator.scheme = method.scheme;
  settings.integrator.substeps.reset();
  settings.step = step;
  return !stability_problem(settings, make_system(settings));
}

/// Returns a case with the default tolerance: replaces the scene's [integrator] table.
StudyCase by_default(const std::string& file, const AccuracyOptions& options, StepMethod method, std::string label) {
  StudyCase study_case = base_case(file, options, std::move(label));
  const std::string scheme =
      is_explicit(method.method) ? "" : fmt::format(",scheme=\"{}\"", scheme_name(method.scheme));
  study_case.overrides.push_back(fmt::format("integrator={{method=\"{}\"{}}}", method_name(method.method), scheme));
  study_case.patience = options.patience;
  return study_case;
}

/// Adds an accuracy to a case. Accuracy needs a second-order scheme, also beside fixed steps of another scheme.
void ask(StudyCase& study_case, StepMethod method, double accuracy) {
  if (!is_explicit(method.method))
    study_case.overrides.push_back("integrator.scheme=" + scheme_name(TimeScheme::sdirk2));
  study_case.overrides.push_back("time.accuracy=" + plain_number(accuracy));
}

/// Returns a case that fails only if the method cannot compute the scene with any step.
StudyCase easiest_case(const std::string& file, const AccuracyOptions& options, StepMethod method) {
  StudyCase study_case = by_default(file, options, method, "");
  ask(study_case, method, 1);  // so that no step is rejected for its length
  return study_case;
}

void add_tolerance_cases(AccuracyCases& cases, const Scene& scene, const std::string& file,
                         const AccuracyOptions& options, StepMethod method) {
  for (const double tolerance : options.tolerances) {
    StudyCase study_case =
        make_case(file, options, method, fmt::format("{}, ε = {:g}", step_method_name(method), tolerance));
    add_tolerance(study_case, tolerance);
    study_case.steps = steps_until(options.times.back(), scene.simulation.step);
    study_case.watched_steps = scene.step_count();
    cases.tolerances.push_back({method, tolerance, std::move(study_case)});
  }
}

void add_step_case(AccuracyCases& cases, const std::string& file, const AccuracyOptions& options, StepMethod method,
                   double step) {
  StudyCase study_case =
      make_case(file, options, method, fmt::format("{}, h = {:g} s", step_method_name(method), step));
  study_case.overrides.push_back("time.step=" + plain_number(step));
  if (!is_explicit(method.method)) {
    study_case.overrides.emplace_back("integrator.stop=change");
    add_tolerance(study_case, small_tolerance);
  }
  study_case.steps = steps_until(options.times.front(), step);
  cases.steps.push_back({method, step, std::move(study_case)});
}

void add_fixed_case(AccuracyCases& cases, const std::string& file, const AccuracyOptions& options, StepMethod method,
                    double step) {
  StudyCase study_case =
      by_default(file, options, method, fmt::format("{}, h = {:g} s", step_method_name(method), step));
  study_case.overrides.push_back("time.step=" + plain_number(step));
  study_case.steps = steps_until(options.times.front(), step);
  study_case.watched_steps = steps_until(options.times.back(), step);
  cases.fixed.push_back({method, step, std::move(study_case)});
}

void add_asked_case(AccuracyCases& cases, const Scene& scene, const std::string& file, const AccuracyOptions& options,
                    StepMethod method, double accuracy) {
  StudyCase study_case =
      by_default(file, options, method, fmt::format("{}, accuracy = {:g} m", step_method_name(method), accuracy));
  ask(study_case, method, accuracy);
  study_case.steps = steps_until(options.times.front(), scene.simulation.step);
  study_case.watched_steps = steps_until(options.times.back(), scene.simulation.step);
  cases.asked.push_back({method, accuracy, std::move(study_case)});
}

}  // namespace

void leave_out_methods(const LoadedScene& scene, const std::string& file, AccuracyOptions& options,
                       std::vector<std::string>& notes) {
  const std::vector<StepMethod> given = options.methods;
  std::erase_if(options.methods, [&](StepMethod method) {
    try {
      static_cast<void>(easiest_case(file, options, method).load());
      return false;
    } catch (const UsageError& error) {
      notes.push_back(
          fmt::format("{} cannot compute {}: {}", step_method_name(method), shown(scene.source.file), error.what()));
      return true;
    }
  });
  if (options.methods.empty()) options.methods = given;  // their error messages explain why none can run
}

AccuracyCases accuracy_cases(const Scene& scene, const std::string& file, const AccuracyOptions& options,
                             std::vector<std::string>& notes) {
  AccuracyCases cases;
  for (const StepMethod method : options.methods) {
    cases.easiest.push_back(easiest_case(file, options, method));
    if (options.parts.solve && !is_explicit(method.method) && method.scheme == TimeScheme::backward_euler) {
      add_tolerance_cases(cases, scene, file, options, method);
    }
    std::string unstable;
    for (const double step : options.steps) {
      if (!is_stable(scene.simulation, method, step)) {
        unstable += fmt::format("{}{:g}", unstable.empty() ? "" : ", ", step);
        continue;
      }
      if (options.parts.order) add_step_case(cases, file, options, method, step);
      if (options.parts.asked) add_fixed_case(cases, file, options, method, step);
    }
    if (!unstable.empty() && (options.parts.order || options.parts.asked)) {
      notes.push_back(fmt::format("{} is unstable with h = {} s in {} and was not run there.", step_method_name(method),
                                  unstable, file));
    }
    if (!options.parts.asked || method.method == Method::semi_implicit) continue;  // Verlet reaches an accuracy instead
    for (const double accuracy : options.accuracies) add_asked_case(cases, scene, file, options, method, accuracy);
  }
  return cases;
}

}  // namespace drape
