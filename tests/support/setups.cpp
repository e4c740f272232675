#include "tests/support/setups.hpp"

#include <cstring>
#include <numeric>
#include <utility>

#include "tests/support/random.hpp"

namespace drape::test {

SimulationSettings setup(Cloth cloth, Solver solver, double step) {
  SimulationSettings settings;
  settings.cloth = std::move(cloth);
  settings.step = step;
  settings.integrator.method = solver.method;
  settings.integrator.scheme = solver.scheme;
  settings.integrator.linear_solver = solver.linear_solver;
  settings.integrator.stop = StoppingRule::change;
  settings.integrator.tolerance = 1e-3;
  return settings;
}

Cloth cloth_of(const Mesh& mesh, double mass, double stiffness, std::vector<int> pins) {
  return make_cloth(mesh, mesh, mass, stiffness, std::move(pins));
}

SimulationSettings homework(Solver solver, double step, double stiffness) {
  SimulationSettings settings = setup(cloth_of(make_grid(20, 20), 1, stiffness, {0, 20}), solver, step);
  settings.effects.add(Gravity{});
  return settings;
}

Sphere homework_sphere() {
  return {.center = homework_sphere_center.transpose(), .radius = 0.4, .scale = 1.1, .stiffness = 8000};
}

Damping homework_damping() { return {.factor = 0.2}; }

std::vector<std::string> problems(const Effect& effect, const SimulationSettings& settings) {
  std::vector<std::string> found;
  effect.check(settings, [&](std::string_view key, const std::string& sentence) {
    found.push_back(std::string(key) + ": " + sentence);
  });
  return found;
}

std::vector<int> every(int count) {
  std::vector<int> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

Vertices random_vertices(Eigen::Index count, int seed) {
  Random random(static_cast<std::uint64_t>(seed));
  Vertices result(count, 3);
  for (Eigen::Index t = 0; t < result.size(); ++t) result.data()[t] = random.between(-1, 1);
  return result;
}

bool same_bits(const Vertices& a, const Vertices& b) {
  return a.rows() == b.rows() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

}  // namespace drape::test
