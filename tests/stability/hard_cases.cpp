#include "tests/stability/hard_cases.hpp"

#include <algorithm>
#include <filesystem>

#include "drape/scene/scene.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

namespace fs = std::filesystem;

/// Makes vertices anywhere in a cube of 2 m, at up to 1000 m/s along each axis.
SimulationSettings random_state(double stiffness, double step) {
  SimulationSettings settings = setup(cloth_of(make_grid(8, 8), 1, stiffness, {}), Method::liu13, step);
  settings.cloth.positions = random_vertices(81, 1);
  settings.cloth.velocities = 1000 * random_vertices(81, 2);
  settings.integrator.tolerance = 1e-6;
  return settings;
}

/// Makes sheets that share an edge, with vertices of very different masses.
SimulationSettings uneven_masses() {
  SimulationSettings settings = setup(cloth_of(three_sheets(4), 1, 180, {0}), Method::liu13, 0.01);
  for (int i = 0; i < settings.cloth.vertex_count(); ++i) settings.cloth.masses[i] *= std::pow(10.0, i % 7 - 3);
  settings.integrator.tolerance = 1e-6;
  settings.effects = {Gravity{}};
  return settings;
}

std::vector<HardCase> find_cases() {
  std::vector<HardCase> cases;
  for (const auto& entry : fs::directory_iterator(DRAPE_SOURCE_DIR "/scenes/hard")) {
    if (entry.path().extension() != ".toml") continue;
    cases.push_back({.name = entry.path().stem().string(), .file = entry.path().string(), .make = {}});
  }
  std::sort(cases.begin(), cases.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  const auto add = [&](const char* name, std::function<SimulationSettings()> make) {
    cases.push_back({.name = name, .file = {}, .make = std::move(make)});
  };
  add("random_state", [] { return random_state(180, 0.01); });
  add("random_state_stiffest", [] { return random_state(1e9, 0.01); });
  add("random_state_longest_step", [] { return random_state(180, 1); });
  add("uneven_masses", uneven_masses);
  return cases;
}

}  // namespace

const std::vector<HardCase>& hard_cases() {
  static const std::vector<HardCase> cases = find_cases();
  return cases;
}

HardRun load(const HardCase& hard, Solver solver, const std::vector<std::string>& more) {
  if (hard.file.empty()) {
    HardRun run{hard.make(), hard.steps};
    run.settings.integrator.method = solver.method;
    run.settings.integrator.scheme = solver.scheme;
    run.settings.integrator.linear_solver = solver.linear_solver;
    return run;
  }
  std::vector<std::string> overrides{"integrator.method=" + drape::method_name(solver.method)};
  if (!solver.is_explicit()) overrides.push_back("integrator.scheme=" + scheme_name(solver.scheme));
  if (solver.linear_solver == LinearSolver::cholesky) overrides.emplace_back("integrator.linear_solver=cholesky");
  overrides.insert(overrides.end(), more.begin(), more.end());
  Scene scene = load_scene(hard.file, overrides);
  const std::int64_t steps = scene.step_count();
  return {std::move(scene.simulation), steps};
}

std::string case_and_method(const testing::TestParamInfo<std::tuple<HardCase, NamedMethod>>& info) {
  return std::get<0>(info.param).name + "_" + std::get<1>(info.param).name;
}

}  // namespace drape::test
