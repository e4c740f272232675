// The methods that minimise the implicit step find the same minimum if it is unique. A cloth crumpled strongly within a
// step has several of nearly equal g, between which methods may differ. So the states at k = 1800 N/m come from a
// motion with shorter steps, and the first one on the sphere is after the landing.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drape/sim/simulation.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"

namespace drape::test::one_step {
namespace {

struct Case {
  const char* name;
  SimulationSettings (*make)();
  std::vector<int> steps;  // of the motion; every method computes a step after each
  double tolerance;        // [N]; m/h² exceeds 5 N/m in all of them, so this is far below the distance
  double distance;         // within which all methods end [m]
};

SimulationSettings hanging(const Mesh& mesh, int second_pin, double stiffness) {
  SimulationSettings settings = setup(cloth_of(mesh, 1, stiffness, {0, second_pin}), Method::liu13, 0.02);
  settings.effects.add(Gravity{});
  return settings;
}

const Case cases[] = {
    {"Grid18", [] { return homework(Method::liu13, 0.02, 18); }, {20, 50, 120, 300}, 1e-9, 1e-8},
    {"Grid180", [] { return homework(Method::liu13, 0.02, 180); }, {20, 50, 120, 300}, 1e-9, 1e-8},
    {"Grid1800", [] { return homework(Method::liu13, 0.005, 1800); }, {80, 200, 480}, 1e-8, 1e-8},
    {"GridOnSphere",
     [] {
       SimulationSettings settings = homework(Method::liu13, 0.02, 180);
       settings.effects.add(homework_sphere());
       return settings;
     },
     {50, 120, 300},
     1e-9,
     1e-8},
    {"Irregular", [] { return hanging(irregular_mesh(12), 7, 180); }, {20, 50, 120, 300}, 1e-9, 1e-8},
    {"ThreeTrianglesOnAnEdge", [] { return hanging(three_sheets(8), 8, 180); }, {20, 50, 120, 300}, 1e-9, 1e-8},
};

class OneStep : public testing::TestWithParam<Case> {};

TEST_P(OneStep, EndsAtTheSamePlaceWithEveryMethod) {
  Simulation motion(GetParam().make());
  for (const int step : GetParam().steps) {
    while (motion.state().step < step) motion.step();
    std::vector<Vertices> ends;
    for (const NamedMethod& method : implicit_methods) {
      SimulationSettings settings = GetParam().make();
      settings.integrator.method = method.method;
      settings.integrator.linear_solver = method.linear_solver;
      settings.integrator.stop = StoppingRule::gradient;
      settings.integrator.tolerance = GetParam().tolerance;
      settings.integrator.max_iterations = 100'000;
      Simulation simulation(settings);
      simulation.restore(motion.state());
      const StepReport report = simulation.step();
      ASSERT_TRUE(report.converged) << method.name;
      ends.push_back(simulation.state().x);
    }
    for (std::size_t m = 1; m < ends.size(); ++m) {
      EXPECT_LT((ends[m] - ends[0]).rowwise().norm().maxCoeff(), GetParam().distance)
          << implicit_methods[m].name << " and " << implicit_methods[0].name << " after " << step << " steps";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, OneStep, testing::ValuesIn(cases), [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace drape::test::one_step
