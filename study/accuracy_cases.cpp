#include "study/accuracy_cases.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/make_system.hpp"
#include "sim/schemes/registry.hpp"

namespace drape {
namespace {

// Of the cases that differ in their step: so small that the error of the solve is not seen beside that of the step.
constexpr double small_tolerance = 1e-9;

StudyCase make_case(const std::string& file, const AccuracyOptions& options, StepMethod method, std::string label) {
  StudyCase what;
  what.label = std::move(label);
  what.scene = file;
  what.folder = std::filesystem::current_path();
  what.overrides = options.overrides;
  what.overrides.push_back("integrator.method=" + method_name(method.method));
  if (!is_explicit(method.method)) what.overrides.push_back("integrator.scheme=" + scheme_name(method.scheme));
  return what;
}

void add_tolerance(StudyCase& what, double tolerance) {
  what.overrides.push_back("integrator.tolerance=" + plain_number(tolerance));
  what.overrides.push_back(fmt::format("integrator.max_iterations={}", most_study_iterations));
}

/// Whether a method can take steps of this length.
bool is_stable(SimulationSettings settings, StepMethod method, double step) {
  settings.integrator.method = method.method;
  settings.integrator.scheme = method.scheme;
  settings.step = step;
  return !stability_problem(settings, make_system(settings));
}

}  // namespace

AccuracyCases accuracy_cases(const Scene& scene, const std::string& file, const AccuracyOptions& options,
                             std::vector<std::string>& notes) {
  AccuracyCases cases;
  for (const StepMethod method : options.methods) {
    if (!is_explicit(method.method) && method.scheme == TimeScheme::backward_euler) {
      for (const double tolerance : options.tolerances) {
        StudyCase what =
            make_case(file, options, method, fmt::format("{}, ε = {:g}", step_method_name(method), tolerance));
        add_tolerance(what, tolerance);
        what.steps = std::llround(options.times.back() / scene.simulation.step);
        what.watched_steps = scene.step_count();
        cases.tolerances.push_back({method, tolerance, std::move(what)});
      }
    }
    std::string unstable;
    for (const double step : options.steps) {
      if (!is_stable(scene.simulation, method, step)) {
        unstable += fmt::format("{}{:g}", unstable.empty() ? "" : ", ", step);
        continue;
      }
      StudyCase what = make_case(file, options, method, fmt::format("{}, h = {:g} s", step_method_name(method), step));
      what.overrides.push_back("time.step=" + plain_number(step));
      if (!is_explicit(method.method)) {
        what.overrides.emplace_back("integrator.stop=change");
        add_tolerance(what, small_tolerance);
      }
      what.steps = std::llround(options.times.front() / step);
      cases.steps.push_back({method, step, std::move(what)});
    }
    if (!unstable.empty()) {
      notes.push_back(fmt::format("{} is unstable with h = {} s in {} and was not run there.", step_method_name(method),
                                  unstable, file));
    }
  }
  return cases;
}

}  // namespace drape
