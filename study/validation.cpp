#include "study/validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <thread>

#include "core/error.hpp"
#include "core/nearest.hpp"
#include "scene/method_names.hpp"
#include "sim/simulation.hpp"
#include "study/measure.hpp"
#include "study/validation_measures.hpp"

namespace drape {
namespace {

StudyCase study_case(const ValidationCase& of, const ValidationProblem& problem,
                     const std::vector<std::string>& overrides, const std::string& label) {
  StudyCase what;
  what.label = label;
  what.scene = of.scene;
  what.overrides = problem.overrides;
  what.overrides.insert(what.overrides.end(), overrides.begin(), overrides.end());
  what.steps = what.load().step_count();
  return what;
}

void plan_case(const ValidationCase& of, const ValidationOptions& options, std::vector<ValidationRun>& runs) {
  const auto add = [&](const ValidationProblem& problem, const std::string& factor, const std::string& setting,
                       const std::vector<std::string>& overrides) {
    ValidationRun& run = runs.emplace_back();
    run.name = of.name;
    run.problem = problem.name;
    run.factor = factor;
    run.setting = setting;
    run.what = study_case(of, problem, overrides, setting);
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
    const Scene scene = run.what.load();
    run.step = scene.simulation.step;
    run.cell = mean_spring_length(scene.simulation.cloth);
    run.vertices = scene.simulation.cloth.vertex_count();
    ValidationMotion motion(of, scene);
    std::optional<StudyMotionRecorder> recorder;
    if (is_shown(of, run)) recorder.emplace(scene);
    for (std::int64_t step = 0; step < run.what.steps; ++step) {
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
    const Scene scene = run.what.load();
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

ValidationStudy plan_validation(const ValidationOptions& options) {
  require_methods(options.methods);
  ValidationStudy study;
  study.cases = validation_cases(options.cases);
  for (const ValidationCase& one : study.cases) plan_case(one, options, study.runs);
  study.shard = options.shard;
  if (!options.shard.whole()) keep_shard(options.shard, study.runs);
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
