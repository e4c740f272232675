#include "study/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/stability.hpp"
#include "study/accuracy_cases.hpp"
#include "study/step_reference.hpp"

namespace drape {
namespace {

constexpr std::int64_t states = 12;              // along the reference, from which steps are solved
constexpr double shortest_part = 1e-9;           // of a step, that rounding may make
constexpr std::int64_t most_small_steps = 2000;  // of the smallest default step
constexpr int most_halvings = 6;

std::int64_t steps_until(double time, double h) { return std::llround(time / h); }

std::vector<double> default_steps(double h, double time) {
  std::vector<double> steps;
  for (int i = 0; i <= most_halvings; ++i, h /= 2) {
    if (i > 2 && steps_until(time, h) > most_small_steps) break;
    steps.push_back(h);
  }
  return steps;
}

}  // namespace

AccuracyOptions complete(AccuracyOptions options, const Scene& scene) {
  const double h = scene.simulation.step, duration = scene.duration;
  if (options.methods.empty()) {
    options.methods = {Method::implicit,
                       Method::liu13,
                       Method::quasi_newton,
                       Method::semi_implicit,
                       Method::verlet,
                       {Method::implicit, TimeScheme::sdirk2},
                       {Method::liu13, TimeScheme::sdirk2},
                       {Method::quasi_newton, TimeScheme::sdirk2}};
  }
  if (options.tolerances.empty()) options.tolerances = {1, 0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
  if (options.times.empty()) options.times = {duration / 20, duration / 8, duration / 4};
  for (double& time : options.times) {
    const std::int64_t steps = steps_until(time, h);
    if (steps < 1 || steps > scene.step_count()) {
      throw UsageError(fmt::format("--times: {:g} s is beyond the motion of {}, which lasts {:g} s", time,
                                   scene.file.string(), duration));
    }
    time = static_cast<double>(steps) * h;
  }
  std::sort(options.times.begin(), options.times.end());
  options.times.erase(std::unique(options.times.begin(), options.times.end()), options.times.end());
  if (options.steps.empty()) options.steps = default_steps(h, options.times.front());
  std::sort(options.steps.rbegin(), options.steps.rend());
  for (const double step : options.steps) {
    const double count = options.times.front() / step;
    if (!(count >= 1 - shortest_part) || std::abs(count - std::round(count)) > shortest_part * count) {
      throw UsageError(fmt::format("--steps: {:g} s does not divide {:g} s, the first of --times, in {}", step,
                                   options.times.front(), scene.file.string()));
    }
  }
  return options;
}

namespace {

/// A scene's study while it is done.
class SceneStudy {
 public:
  SceneStudy(const std::string& name, const std::string& file, const AccuracyOptions& asked)
      : scene_(load_scene(file, asked.overrides)) {
    scene_.simulation.integrator.scheme = TimeScheme::backward_euler;  // of the steps whose solves are compared
    result_.name = name;
    result_.scene = file;
    result_.options = complete(asked, scene_);
    result_.step = scene_.simulation.step;
    result_.tolerance_unit = scene_.simulation.integrator.stop == StoppingRule::gradient ? "N" : "m";
    cases_ = accuracy_cases(scene_, file, result_.options, result_.notes);
  }

  /// @throws UsageError if a case or a reference cannot be run
  void check() const {
    for (const ToleranceCase& one : cases_.tolerances) static_cast<void>(one.what.load());
    for (const StepCase& one : cases_.steps) static_cast<void>(one.what.load());
    for (const Method method : {Method::implicit, Method::quasi_newton}) {
      const Simulation reference(to_rounding(scene_.simulation, method));
    }
  }

  std::optional<SceneAccuracy> run(const std::stop_token& stop, Progress& progress) {
    if (!find_references(stop, progress) || !measure_cases(stop, progress)) return std::nullopt;
    if (!find_solve_errors(stop, progress)) return std::nullopt;
    find_orders();
    return std::move(result_);
  }

 private:
  bool find_references(const std::stop_token& stop, Progress& progress) {
    const std::vector<double>& times = result_.options.times;
    const std::int64_t last = steps_until(times.back(), result_.step);
    const std::int64_t whole = scene_.step_count();
    std::vector<std::int64_t> keep;
    for (std::int64_t i = 0; i < states; ++i) keep.push_back(i * last / states);
    for (const double time : times) keep.push_back(steps_until(time, result_.step));
    std::sort(keep.begin(), keep.end());
    keep.erase(std::unique(keep.begin(), keep.end()), keep.end());
    reference_ = run_reference(scene_.simulation, whole, keep, stop, progress);
    if (!reference_) return false;
    result_.apart_by_step = reference_->apart;
    for (const double time : times) result_.apart.push_back(reference_->apart_after(steps_until(time, result_.step)));
    if (const auto step = reference_->first_beyond(smallest_error)) {
      result_.chaotic_from = static_cast<double>(*step) * result_.step;
    }
    if (cases_.steps.empty()) return true;
    const double smallest = result_.options.steps.back();
    small_steps_ = extrapolate_step(scene_.simulation, times.front(),
                                    reference_refinement * steps_until(times.front(), smallest), stop, progress);
    if (!small_steps_) return false;
    result_.step_reference = small_steps_->step;
    result_.step_gained = small_steps_->gained;
    result_.step_apart = small_steps_->apart;
    return true;
  }

  [[nodiscard]] const State& reference_after(std::int64_t step) const {
    return *std::find_if(reference_->states.begin(), reference_->states.end(),
                         [step](const State& state) { return state.step == step; });
  }

  bool measure_cases(const std::stop_token& stop, Progress& progress) {
    std::vector<StudyCase> all;
    for (const ToleranceCase& one : cases_.tolerances) all.push_back(one.what);
    for (const StepCase& one : cases_.steps) all.push_back(one.what);
    const std::size_t tolerances = cases_.tolerances.size();
    result_.points.resize(tolerances);
    result_.steps.resize(cases_.steps.size());
    const CaseWatch watch = [&](std::size_t number, const Simulation& simulation) {
      const State& state = simulation.state();
      if (number >= tolerances) {
        if (state.step == all[number].steps) {
          result_.steps[number - tolerances].error = distance(state.x, small_steps_->x);
        }
        return;
      }
      for (const double time : result_.options.times) {
        if (state.step != steps_until(time, result_.step)) continue;
        result_.points[number].motion.push_back(distance(state.x, reference_after(state.step).x));
      }
    };
    std::vector<Measured> measured = measure(all, result_.options.runs, stop, progress, watch);
    if (measured.empty()) return false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i < tolerances) {
        result_.points[i].method = cases_.tolerances[i].method;
        result_.points[i].tolerance = cases_.tolerances[i].tolerance;
        result_.points[i].measured = std::move(measured[i]);
      } else {
        StepPoint& point = result_.steps[i - tolerances];
        point.method = cases_.steps[i - tolerances].method;
        point.step = cases_.steps[i - tolerances].step;
        point.measured = std::move(measured[i]);
      }
    }
    return true;
  }

  bool find_solve_errors(const std::stop_token& stop, Progress& progress) {
    progress.begin("solving single steps", "cases", static_cast<std::int64_t>(result_.points.size()));
    const ExactSteps exact(scene_.simulation, reference_->states, smallest_error);
    result_.states = exact.count();
    result_.left_out = exact.left_out();
    result_.solve_apart = exact.apart();
    for (TolerancePoint& point : result_.points) {
      if (stop.stop_requested()) return false;
      point.solve = exact.error(point.measured.what.load().simulation.integrator);
      ++progress.done;
    }
    return true;
  }

  void find_orders() {
    for (std::size_t i = 0; i < result_.steps.size(); ++i) {
      StepPoint& point = result_.steps[i];
      const bool first = i == 0 || result_.steps[i - 1].method != point.method;
      const StepPoint& larger = result_.steps[first ? i : i - 1];
      point.order = first ? std::numeric_limits<double>::quiet_NaN()
                          : std::log(larger.error.max / point.error.max) / std::log(larger.step / point.step);
    }
  }

  Scene scene_;
  SceneAccuracy result_;
  AccuracyCases cases_;
  std::optional<ReferenceMotion> reference_;
  std::optional<StepReference> small_steps_;
};

}  // namespace

void check_accuracy(const std::string& file, const AccuracyOptions& options) { SceneStudy({}, file, options).check(); }

std::optional<SceneAccuracy> study_accuracy(const std::string& name, const std::string& file,
                                            const AccuracyOptions& options, const std::stop_token& stop,
                                            Progress& progress) {
  return SceneStudy(name, file, options).run(stop, progress);
}

}  // namespace drape
