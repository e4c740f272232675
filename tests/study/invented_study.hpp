#pragma once

#include <string>

#include "study/accuracy_report.hpp"

namespace drape::test {

/// Makes runs with these times per second of motion [ms].
inline CaseRuns invented_runs(const std::string& scene, double step, std::vector<double> costs) {
  CaseRuns runs;
  runs.study_case = {"a \"label\", quoted", scene, {"time.step=0.01", "integrator={method=\"liu13\"}"}, 10, 20};
  runs.step = step;
  runs.iterations = 1.0 / 3;
  runs.capped = 2;
  for (const double cost : costs) runs.microseconds.push_back(1e3 * cost * step);
  return runs;
}

inline MotionPoint invented_motion(const std::string& scene, StepMethod method, double setting, double error,
                                   std::vector<double> costs) {
  MotionPoint point;
  point.method = method;
  point.setting = setting;
  point.measured = invented_runs(scene, 0.02, std::move(costs));
  point.errors = {{error, error / 2}};
  return point;
}

/// Makes a scene with every possible finding of a study, with invented numbers.
inline SceneAccuracy invented_scene(const std::string& name) {
  SceneAccuracy s;
  s.name = name;
  s.scene = name + ".toml";
  s.options.methods = {Method::implicit, Method::verlet};
  s.options.tolerances = {1e-3};
  s.options.steps = {0.02, 0.01};
  s.options.times = {0.2};
  s.options.accuracies = {1e-3, 1e-4};
  s.options.overrides = {"cloth.mass=2"};
  s.options.parts.films = true;
  s.step = 0.02;
  s.apart = {1e-9};
  s.apart_by_step = {1e-12, 3e-12, 1e-9};
  s.buckling_from = 0.1;
  s.solve_apart = 1e-11;
  s.states = 12;
  s.step_reference = 0.02 / 8;
  s.step_gained = {1e-6};
  s.film_unknown = 0.001;
  s.notes = {"One thing, and\nanother \"thing\"."};
  TolerancePoint tolerance{
      Method::implicit, 1e-3, invented_runs(s.scene, 0.02, {3, 1, 2}), {1e-4, 1e-5, 0.1}, {{1e-3, 1e-4}}};
  tolerance.measured.setup = {0.1, 0.3, 0.2};
  s.points = {tolerance};
  for (const double step : s.options.steps) {
    s.steps.push_back({Method::implicit, step, invented_runs(s.scene, step, {1, 2, 3}), {step / 10, step / 30}, 0});
  }
  find_orders(s.steps);
  s.fixed = {invented_motion(s.scene, Method::implicit, 0.02, 5e-3, {10, 11, 12}),
             invented_motion(s.scene, Method::implicit, 0.01, 5e-4, {30, 19, 20, 20, 18, 21}),
             invented_motion(s.scene, Method::verlet, 0.02, 4e-4, {}),
             invented_motion(s.scene, Method::verlet, 0.01, 4e-4, {5})};
  s.fixed[2].measured.failure = "it diverged";
  s.fixed[2].errors = {{std::nan(""), std::nan("")}};
  s.asked = {invented_motion(s.scene, Method::implicit, 1e-3, 5e-4, {40}),
             invented_motion(s.scene, Method::implicit, 1e-4, 5e-5, {90, 80, 95})};
  for (MotionPoint& p : s.asked) {
    p.flip = 0.125;
    p.film_flip = {0.1, 0.15};
    // Ten steps, five of them before the cloth buckles; the last misses its tolerance without reporting it.
    p.substeps = {4, 4, 4, 8, 8, 8, 16, 16, 16, 16};
    p.converged.assign(10, 1);
    p.estimates.assign(10, p.setting);
    p.local_errors.assign(10, p.setting);
    p.local_unknown.assign(10, 0.01 * p.setting);
    p.local_errors[2] = 4 * p.setting;
    p.local_errors[9] = 20 * p.setting;
  }
  return s;
}

inline AccuracyStudy invented_study() {
  return {"drape study accuracy a.toml b.toml",
          {invented_scene("a"), invented_scene("b")},
          {{}, {}},
          12.5,
          {{"Processor", "an abacus, 10 rows"}, {"System", "wood"}}};
}

}  // namespace drape::test
