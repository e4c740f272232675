#include "study/accuracy_cases.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/text.hpp"
#include "scene/method_names.hpp"
#include "sim/make_system.hpp"
#include "sim/schemes/registry.hpp"

namespace drape {
namespace {

// Tolerance of the cases that differ in their step: small enough to make the solve's error negligible.
constexpr double small_tolerance = 1e-9;

/// Returns the case of a scene with its own method and the study's overrides.
StudyCase base_case(const std::string& file, const AccuracyOptions& options, std::string label) {
  StudyCase what;
  what.label = std::move(label);
  what.scene = file;
  what.folder = std::filesystem::current_path();
  what.overrides = options.overrides;
  return what;
}

StudyCase make_case(const std::string& file, const AccuracyOptions& options, StepMethod method, std::string label) {
  StudyCase what = base_case(file, options, std::move(label));
  what.overrides.push_back("integrator.method=" + method_name(method.method));
  if (!is_explicit(method.method)) what.overrides.push_back("integrator.scheme=" + scheme_name(method.scheme));
  return what;
}

void add_tolerance(StudyCase& what, double tolerance) {
  what.overrides.push_back("integrator.tolerance=" + plain_number(tolerance));
  what.overrides.push_back(fmt::format("integrator.max_iterations={}", most_study_iterations));
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
  StudyCase what = base_case(file, options, std::move(label));
  const std::string scheme =
      is_explicit(method.method) ? "" : fmt::format(",scheme=\"{}\"", scheme_name(method.scheme));
  what.overrides.push_back(fmt::format("integrator={{method=\"{}\"{}}}", method_name(method.method), scheme));
  what.patience = options.patience;
  return what;
}

/// Adds an accuracy to a case. Accuracy needs a second-order scheme, also beside fixed steps of another scheme.
void ask(StudyCase& what, StepMethod method, double accuracy) {
  if (!is_explicit(method.method)) what.overrides.push_back("integrator.scheme=" + scheme_name(TimeScheme::sdirk2));
  what.overrides.push_back("time.accuracy=" + plain_number(accuracy));
}

void add_tolerance_cases(AccuracyCases& cases, const Scene& scene, const std::string& file,
                         const AccuracyOptions& options, StepMethod method) {
  for (const double tolerance : options.tolerances) {
    StudyCase what = make_case(file, options, method, fmt::format("{}, ε = {:g}", step_method_name(method), tolerance));
    add_tolerance(what, tolerance);
    what.steps = steps_until(options.times.back(), scene.simulation.step);
    what.watched_steps = scene.step_count();
    cases.tolerances.push_back({method, tolerance, std::move(what)});
  }
}

void add_step_case(AccuracyCases& cases, const std::string& file, const AccuracyOptions& options, StepMethod method,
                   double step) {
  StudyCase what = make_case(file, options, method, fmt::format("{}, h = {:g} s", step_method_name(method), step));
  what.overrides.push_back("time.step=" + plain_number(step));
  if (!is_explicit(method.method)) {
    what.overrides.emplace_back("integrator.stop=change");
    add_tolerance(what, small_tolerance);
  }
  what.steps = steps_until(options.times.front(), step);
  cases.steps.push_back({method, step, std::move(what)});
}

void add_fixed_case(AccuracyCases& cases, const std::string& file, const AccuracyOptions& options, StepMethod method,
                    double step) {
  StudyCase what = by_default(file, options, method, fmt::format("{}, h = {:g} s", step_method_name(method), step));
  what.overrides.push_back("time.step=" + plain_number(step));
  what.steps = steps_until(options.times.front(), step);
  what.watched_steps = steps_until(options.times.back(), step);
  cases.fixed.push_back({method, step, std::move(what)});
}

void add_asked_case(AccuracyCases& cases, const Scene& scene, const std::string& file, const AccuracyOptions& options,
                    StepMethod method, double accuracy) {
  StudyCase what =
      by_default(file, options, method, fmt::format("{}, accuracy = {:g} m", step_method_name(method), accuracy));
  ask(what, method, accuracy);
  what.steps = steps_until(options.times.front(), scene.simulation.step);
  what.watched_steps = steps_until(options.times.back(), scene.simulation.step);
  cases.asked.push_back({method, accuracy, std::move(what)});
}

}  // namespace

void leave_out_methods(const Scene& scene, const std::string& file, AccuracyOptions& options,
                       std::vector<std::string>& notes) {
  const std::vector<StepMethod> given = options.methods;
  std::erase_if(options.methods, [&](StepMethod method) {
    StudyCase what = by_default(file, options, method, "");
    ask(what, method, 1);  // so that no step is rejected for its length
    try {
      static_cast<void>(what.load());
      return false;
    } catch (const UsageError& error) {
      notes.push_back(
          fmt::format("{} cannot compute {}: {}", step_method_name(method), shown(scene.file), error.what()));
      return true;
    }
  });
  if (options.methods.empty()) options.methods = given;  // their error messages explain why none can run
}

AccuracyCases accuracy_cases(const Scene& scene, const std::string& file, const AccuracyOptions& options,
                             std::vector<std::string>& notes) {
  AccuracyCases cases;
  for (const StepMethod method : options.methods) {
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
    if (!options.parts.asked) continue;
    for (const double accuracy : options.accuracies) add_asked_case(cases, scene, file, options, method, accuracy);
  }
  return cases;
}

}  // namespace drape
