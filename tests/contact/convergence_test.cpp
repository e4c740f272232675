// Newton's methods solve almost every step in contact. Soft cloth that slides over edges is the hardest: friction
// makes the multipliers circle around the solution.

#include <Eigen/Geometry>

#include "tests/contact/contact_setup.hpp"

namespace drape::test {
namespace {

class Convergence : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, Convergence, testing::Values(contact_methods[0], contact_methods[5]), method_name);

/// Makes a tilted sheet close above z = 0 that falls on obstacles.
SimulationSettings falling_sheet(const NamedMethod& method, double stiffness, double step) {
  Mesh mesh = level_square(1, 12, 0);
  const Eigen::Vector3d axis(0.8, 0.6, 0);
  mesh.positions = (mesh.positions * Eigen::AngleAxisd(0.2, axis).toRotationMatrix().transpose()).eval();
  mesh.positions.col(2).array() += 0.02 - mesh.positions.col(2).minCoeff();
  SimulationSettings settings;
  settings.integrator.method = method.method;
  settings.integrator.scheme = method.scheme;
  settings.step = step;
  settings.cloth = plain_sheet(mesh, stiffness);
  settings.cloth.velocities.col(2).setConstant(-0.5);
  settings.effects = {Gravity{}};
  return settings;
}

/// Returns the number of the next steps that are not solved.
int unsolved(Simulation& simulation, int steps) {
  int found = 0;
  for (int i = 0; i < steps; ++i) found += simulation.step().converged ? 0 : 1;
  return found;
}

TEST_P(Convergence, OfSoftClothOverAPoleAndABox) {
  constexpr int steps = 80;
  for (const double stiffness : {18.0, 180.0}) {
    for (const double step : {0.002, 0.01}) {
      for (const Body& obstacle : {solved_box({0.02, 2, 0.02}, 0), solved_box({0.5, 0.4, 0.25}, 0)}) {
        SimulationSettings settings = falling_sheet(GetParam(), stiffness, step);
        settings.effects.add(obstacle);
        Simulation simulation(settings);
        EXPECT_LE(unsolved(simulation, steps), steps / 20) << stiffness << ", " << step;
      }
    }
  }
}

// Energies of cloth at rest change by less than its tolerances explain.
TEST_P(Convergence, OfClothThatComesToRest) {
  SimulationSettings settings = falling_sheet(GetParam(), 1800, 0.002);
  settings.effects.add(solved_ground());
  settings.effects.add(solved_self());
  Simulation simulation(settings);
  for (int i = 0; i < 250; ++i) simulation.step();
  EXPECT_EQ(unsolved(simulation, 250), 0);
}

}  // namespace
}  // namespace drape::test
